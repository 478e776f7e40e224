test_binary(render_timing
  SOURCES estimate_test.cpp render_timer_test.cpp
  ALONE framing_test.cpp
  LINK render_timing test_meshes
  LABELS gpu)
