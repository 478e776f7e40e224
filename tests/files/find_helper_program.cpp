// Says where the program named by its argument is, as a program does that starts it.
#include <iostream>

#include "files/helper_program.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::cout << scene_analyzer::files::helper_program(argv[1]).string();
  return 0;
}
