//! Photon maps on disk.
