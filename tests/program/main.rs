//! The program `cutlab`, run in folders of its own; with what the library says of the same files.

mod absorption;
mod asked;
mod attribute;
mod backgrounds;
mod bare_index;
mod bench;
#[path = "../common/brilliants.rs"]
mod brilliants;
mod cli;
mod compare;
mod concurrent_outputs;
mod corpus;
#[path = "../common/corpus_folder.rs"]
mod corpus_folder;
mod diagram;
mod edit;
mod error_estimates;
mod exits;
mod hostile;
mod kept_files;
mod kills;
mod load;
mod manual;
mod merge_parts;
mod meshes;
mod mp4;
mod odd_names;
mod optimise;
mod orientation;
mod plots;
mod render_choices;
mod render_files;
mod report;
mod reports;
#[path = "../common/room.rs"]
mod room;
mod same_solid;
mod scene_files;
mod score_batches;
mod streams;
mod sweep;
mod table_files;
mod texts;
mod threads;
mod tolerances;
mod units;
mod user_materials;
mod words;
