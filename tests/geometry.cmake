test_binary(geometry SOURCES geometry_test.cpp weld_tolerance_test.cpp LINK adjacency reference test_meshes LABELS gpu)
