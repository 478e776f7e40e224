// Not allowed: binding 1 is missing.
#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) buffer First { uint first[]; };
layout(set = 0, binding = 2) buffer Third { uint third[]; };

void main() { third[0] = first[0]; }
