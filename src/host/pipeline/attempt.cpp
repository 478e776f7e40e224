#include "pipeline/attempt.h"

#include <fmt/format.h>

#include <new>

#include "base/error.h"
#include "files/file.h"

namespace scene_analyzer::pipeline {

void attempt(const mesh::AssetSource& asset, Outcome& outcome, const std::function<void()>& step) {
  try {
    step();
  } catch (const import::EndedEarly& error) {
    outcome.error = error.what();
    outcome.may_succeed_alone = true;
  } catch (const InputError& error) {
    outcome.error = error.what();
  } catch (const std::filesystem::filesystem_error& error) {
    outcome.error = fmt::format("{}: {}", asset.name, files::describe(error.code()));
  } catch (const std::bad_alloc&) {
    outcome.error = fmt::format("{}: this machine has too little free memory for it", asset.name);
    outcome.may_succeed_alone = true;
  }
}

}  // namespace scene_analyzer::pipeline
