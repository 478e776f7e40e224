# Includes generated headers of several rooms, so it is built after them.
test_binary(interface SOURCES interface_test.cpp LINK cooccurrence planar_groups spectrum LABELS gpu)
add_shaders(interface_test ../../tests/interface/number_members.comp)
