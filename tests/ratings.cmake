test_binary(ratings
  SOURCES aggregate_test.cpp color_test.cpp formulas_test.cpp rate_test.cpp
  LINK ratings)
