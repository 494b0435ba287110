//! How the frame is run: live, to files, to numbers.
