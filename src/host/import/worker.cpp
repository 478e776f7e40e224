// The worker's side: give up rights, check, import on a deep stack, write the answer, vanish.
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <assimp/Importer.hpp>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "base/error.h"
#include "import/asset_files.h"
#include "import/asset_io.h"
#include "import/file_checks.h"
#include "import/file_names.h"
#include "import/gltf_check.h"
#include "import/import.h"
#include "import/sandbox.h"
#include "import/scene_writer.h"
#include "import/wire.h"
#include "import/worker_process.h"

namespace scene_analyzer::import {
namespace {

// Assimp walks node trees and JSON by recursion; files with thousands of levels are real.
constexpr std::size_t kStackBytes = std::size_t{256} << 20;

// Called when memory runs out. What follows may be a clean std::bad_alloc or a crash in a library that did
// not expect it; the parent knows the cause either way.
void report_out_of_memory() {
  wire::write_header_only(kAnswerDescriptor, wire::Status::kOutOfMemory);
  throw std::bad_alloc();
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

// Assimp stores what its importers threw; running out of memory must not read like a reason.
void throw_if_out_of_memory(const Assimp::Importer& importer) {
  if (!importer.GetException()) return;
  try {
    std::rethrow_exception(importer.GetException());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {  // NOLINT(bugprone-empty-catch): every other kind is told by GetErrorString()
  }
}

struct Job {
  std::filesystem::path asset;
  Textures textures = Textures::kLeave;
  std::uint64_t most_triangles = 0;  // 0: no limit
  bool has_file_names = false;       // the asset's files lie under other names
};

void require_few_triangles(std::uint64_t triangles, const Job& job) {
  if (job.most_triangles == 0 || triangles <= job.most_triangles) return;
  throw InputError("holds " + std::to_string(triangles) + " triangles, more than the limit of " +
                   std::to_string(job.most_triangles) + " (--max-triangles)");
}

void import_into(AssetFiles& files, const Job& job, wire::Writer& writer) {
  std::vector<std::string> warnings;
  check_file(files.asset_path(), warnings);
  const ExpectedGltf expected = check_gltf(files, warnings);
  require_few_triangles(expected.triangles.value_or(0), job);  // before they are read
  const std::string replacement =
      expected.replacement.empty() ? replacement_for(files.asset_path()) : expected.replacement;
  Assimp::Importer importer;
  importer.SetIOHandler(new AssetIo(files, replacement));  // which the importer owns
  if (importer.ReadFile("./" + files.asset_name(), aiProcess_Triangulate) == nullptr) {
    throw_if_out_of_memory(importer);
    throw InputError(explain_failure(importer.GetErrorString(), files.asset_path()));
  }
  aiScene* const scene = importer.GetOrphanedScene();  // freed by the end of the process
  require_expected(expected, *scene);
  const std::uint64_t triangles = count_triangles(*scene);
  require_few_triangles(triangles, job);
  require_content(files.asset_path(), scene->mNumMeshes, triangles, warnings);
  write_scene(*scene, expected.materials, files, std::move(warnings), job.textures, writer);
}

void refuse(const std::string& reason) {
  wire::Writer writer(kAnswerDescriptor);
  writer.string(one_line(reason));
  writer.finish(wire::Status::kRefused);
}

// Mappings and threads fail with these when there is no room left.
void refuse_system_error(const std::system_error& error) {
  if (error.code() == std::errc::not_enough_memory ||
      error.code() == std::errc::resource_unavailable_try_again)
    wire::write_header_only(kAnswerDescriptor, wire::Status::kOutOfMemory);
  else
    refuse(error.what());
}

void run(const Job& job) {
  try {
    const std::string path = job.asset.filename().string();
    AssetFiles files = job.has_file_names ? AssetFiles(path, read_file_names(".")) : AssetFiles(path);
    wire::Writer writer(kAnswerDescriptor);
    import_into(files, job, writer);
  } catch (const std::bad_alloc&) {
    wire::write_header_only(kAnswerDescriptor, wire::Status::kOutOfMemory);
  } catch (const std::system_error& error) {
    refuse_system_error(error);
  } catch (const std::exception& error) {
    refuse(error.what());
  }
}

// What is told to whoever asked, perhaps over a network, does not name the folder.
void enter(const std::filesystem::path& folder) {
  if (::chdir(folder.c_str()) != 0)
    throw std::system_error(errno, std::generic_category(), "entering the asset's folder");
}

// Near the limit glibc finds no room for a second thread's arena and gives every small block a mapping of its
// own, which is a thousand times slower and lasts until the time limit: one arena for all.
void use_one_arena() {
  ::mallopt(M_ARENA_MAX, 1);
}

void run_on_deep_stack(Job& job) {
  pthread_attr_t attributes;
  pthread_t thread;
  const auto check = [](int error) {
    if (error != 0) throw std::system_error(error, std::generic_category(), "starting the importer");
  };
  check(pthread_attr_init(&attributes));
  check(pthread_attr_setstacksize(&attributes, kStackBytes));
  const auto start = [](void* argument) -> void* {
    run(*static_cast<Job*>(argument));
    return nullptr;
  };
  check(pthread_create(&thread, &attributes, start, &job));
  check(pthread_join(thread, nullptr));
}

std::uint64_t number(const char* text) {
  std::uint64_t value = 0;
  const char* const end = text + std::strlen(text);
  if (std::from_chars(text, end, value).ptr != end) throw std::invalid_argument(text);
  return value;
}

}  // namespace

int worker_main(int argc, char** argv) {
  if (argc != 9) return 2;  // started by hand: it has no one to answer to
  try {
    Job job{argv[2], number(argv[6]) != 0 ? Textures::kDecode : Textures::kLeave, number(argv[7]),
            number(argv[8]) != 0};
    // The stack is room that most files never touch: it comes on top of what the import may take.
    limit_this_process(number(argv[3]) + kStackBytes, number(argv[4]), static_cast<pid_t>(number(argv[5])));
    if (job.asset.has_parent_path()) enter(job.asset.parent_path());
    allow_reading_only(".", job.asset.filename());
    allow_computing_only();
    std::set_new_handler(report_out_of_memory);
    use_one_arena();
    run_on_deep_stack(job);
  } catch (const std::system_error& error) {
    refuse_system_error(error);
  } catch (const std::exception& error) {
    refuse(std::string("the importer could not be set up: ") + error.what());
  }
  // No destructors: freeing millions of faces one by one takes as long as reading them.
  std::_Exit(0);
}

}  // namespace scene_analyzer::import
