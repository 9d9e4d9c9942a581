//! What is kept about the sources and the manifest: layers of files, circles, features.

mod circles;
mod features;
mod layers;
mod root_names;
