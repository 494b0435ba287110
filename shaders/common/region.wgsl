// Which blocks of a texture one dispatch covers: a workgroup each. Changes in many places are one dispatch over a list of the
// blocks that they touch; a change of everything needs no list.

struct Blocks {
    first: u32, // of the listed blocks, in the pass's list
    count: u32, // how many; 0: every block there is
}

// Where a workgroup's block stands, in blocks; beyond every texture for a workgroup past the last. A pass defines
// `listed_block`: column and row of an item of its list, 16 bits each.
fn block_of(blocks: Blocks, workgroup: vec3u, workgroups: vec3u) -> vec2u {
    if blocks.count == 0u {
        return workgroup.xy;
    }
    let index = workgroup.y * workgroups.x + workgroup.x;
    if index >= blocks.count {
        return vec2u(0xffffffu);
    }
    let item = listed_block(blocks.first + index);
    return vec2u(item & 0xffffu, item >> 16u);
}
