test_binary(adjacency SOURCES adjacency_test.cpp LINK adjacency reference test_meshes LABELS gpu)
