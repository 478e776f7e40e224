test_binary(defects SOURCES defects_test.cpp far_from_origin_test.cpp LINK defects reference test_meshes LABELS gpu)
