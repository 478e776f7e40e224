test_binary(cooccurrence SOURCES cooccurrence_test.cpp histogram_test.cpp
            LINK cooccurrence reference test_meshes LABELS gpu)
