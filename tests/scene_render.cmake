test_binary(scene_render
  SOURCES camera_test.cpp drawable_mesh_test.cpp scene_model_test.cpp scene_renderer_test.cpp
  LINK scene_render test_meshes
  LABELS gpu)
