# The demo scene: the committed file is what its generator writes, and its ratings are the thesis'.
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
set(scene_copy ${CMAKE_CURRENT_BINARY_DIR}/living-room.glb)
add_test(NAME examples.generate
         COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/examples/generate_living_room.py ${scene_copy})
add_test(NAME examples.committed_file_is_generated
         COMMAND ${CMAKE_COMMAND} -E compare_files ${scene_copy} ${CMAKE_SOURCE_DIR}/examples/living-room.glb)
add_test(NAME examples.ratings_of_the_thesis
         COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/examples/check_living_room.py ${scene_copy})
add_test(NAME examples.check_notices_a_wrong_scene
         COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/tests/examples/broken_scenes.py)
set_tests_properties(examples.generate PROPERTIES FIXTURES_SETUP demo_scene)
set_tests_properties(examples.committed_file_is_generated examples.ratings_of_the_thesis
                     PROPERTIES FIXTURES_REQUIRED demo_scene)
