test_binary(pipeline
  SOURCES ../support/worker_main.cpp analysis_store_test.cpp measure_test.cpp corpus_test.cpp group_sizes_test.cpp options_test.cpp pack_test.cpp pipeline_test.cpp pipeline_timing_test.cpp
  LINK pipeline reference test_meshes
  LABELS gpu)
