test_binary(gpu
  SOURCES buffer_test.cpp device_selection_test.cpp device_test.cpp drawing_test.cpp host_memory_test.cpp kernel_test.cpp
          pipeline_cache_test.cpp recorder_test.cpp reflection_test.cpp validation_test.cpp
  ALONE raster_state_test.cpp
  LINK gpu Vulkan::Headers spdlog::spdlog
  LABELS gpu)
add_shaders(gpu_test
  ../../tests/gpu/write_index.comp ../../tests/gpu/add_scaled.comp ../../tests/gpu/write_constants.comp
  ../../tests/gpu/flat.vert ../../tests/gpu/flat.frag ../../tests/gpu/textured.frag
  ../../tests/gpu/echo_params.comp ../../tests/gpu/gap_in_bindings.comp)
