//! Files in and out: height images of every kind, whole, odd, damaged and hostile; scenes; what a script is promised to find.

mod colour_image;
mod font;
mod height_image;
mod image_sequence;
mod scene_file;
