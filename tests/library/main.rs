//! The library, used as any program uses it.

mod absorbing_stones;
mod attribution;
mod beam_reciprocity;
mod beams;
#[path = "../common/brilliants.rs"]
mod brilliants;
mod colour;
#[path = "../common/corpus_folder.rs"]
mod corpus_folder;
mod coverage;
mod cuts;
mod cutting_errors;
mod daylight;
mod depth_of_field;
mod designs;
mod dialects;
mod edit;
mod estimate;
mod exact;
mod examples;
mod extending;
mod faceter_view;
mod fancy;
mod fire;
mod formats;
mod furnace;
mod geometry;
mod horizon;
mod instruction_sets;
mod meet;
mod objective;
mod optics;
mod optimised_page;
mod outlines;
mod polarisation;
mod progress;
mod progressive;
mod receivers;
mod render;
mod requests;
#[path = "../common/room.rs"]
mod room;
mod round_brilliant;
mod scintillation;
mod score_promises;
mod scores;
mod search;
mod tilts;
mod trace;
mod validate;
mod variants;
mod weighted_exits;
mod write_back;
