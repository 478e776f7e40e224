test_binary(planar_groups SOURCES planar_groups_test.cpp LINK planar_groups reference test_meshes LABELS gpu)
