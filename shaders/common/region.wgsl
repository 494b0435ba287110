// The part of the field that one dispatch covers. Dirty rectangles of several places are several dispatches.

struct Region {
    origin: vec2u, // its first texel
    extent: vec2u, // width and height, texels
}
