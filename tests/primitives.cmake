test_binary(primitives SOURCES primitives_test.cpp LINK primitives test_meshes LABELS gpu)
