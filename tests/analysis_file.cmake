test_binary(analysis_file
  SOURCES round_trip_test.cpp damaged_test.cpp stale_test.cpp file_names_test.cpp path_test.cpp store_test.cpp prune_test.cpp
          ../support/hooked_sync.cpp
  LINK analysis_file analysis_proto)
