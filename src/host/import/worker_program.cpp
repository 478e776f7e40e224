// The program `scene-analyzer-import`: the import worker and nothing else.
#include "import/import.h"

int main(int argc, char** argv) {
  return scene_analyzer::import::worker_main(argc, argv);
}
