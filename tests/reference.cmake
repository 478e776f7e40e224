add_subdirectory(${CMAKE_CURRENT_LIST_DIR}/reference)
test_binary(reference
  SOURCES adjacency_test.cpp area_classes_test.cpp catalogue_test.cpp cooccurrence_test.cpp evaluate_test.cpp
          planar_groups_test.cpp spectrum_test.cpp triangles_test.cpp weld_test.cpp
  LINK reference test_meshes)
