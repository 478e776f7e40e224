// threads.glsl — A linear index over workgroups that the recorder may have folded into y.
//
// Include it after layout(local_size_x = ...): before, glslang takes gl_WorkGroupSize for 1 without a word.
#ifndef SCENE_ANALYZER_LIB_THREADS
#define SCENE_ANALYZER_LIB_THREADS

uint global_group() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
uint global_thread() { return global_group() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

#endif
