test_binary(surface_distances SOURCES bounds_test.cpp shortest_paths_test.cpp signal_test.cpp
            ALONE lane_search_test.cpp
  LINK surface_distances reference test_meshes LABELS gpu)
