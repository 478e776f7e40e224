test_binary(pictures
  SOURCES compose_test.cpp picture_content_test.cpp
  LINK pictures PkgConfig::cairo)
