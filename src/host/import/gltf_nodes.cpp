#include "import/gltf_nodes.h"

#include <cstdint>

#include "base/error.h"
#include "import/gltf_document.h"

namespace scene_analyzer::import {
namespace {

using nlohmann::json;

constexpr double kMostNodes = 1e7;

std::vector<std::uint64_t> node_numbers(const json& array, std::size_t nodes, const std::string& where) {
  std::vector<std::uint64_t> numbers;
  for (const json& value : array) {
    if (!value.is_number_unsigned()) throw InputError(where + " names a node that is not a number");
    numbers.push_back(value.get<std::uint64_t>());
    if (numbers.back() >= nodes)
      throw InputError(where + " names node " + std::to_string(numbers.back()) + ", which does not exist");
  }
  return numbers;
}

std::vector<std::uint64_t> roots_of(const json& root, std::size_t nodes) {
  const json& scenes = array_of(root, "scenes", "the file");
  if (scenes.empty()) throw InputError("has no scene: nothing in it is shown; export it with a scene");
  const std::uint64_t shown = whole_number(root, "scene", 0, "the file");
  if (shown >= scenes.size())
    throw InputError("its default scene " + std::to_string(shown) + " does not exist");
  if (!scenes[shown].is_object()) throw InputError("its default scene is not an object");
  return node_numbers(array_of(scenes[shown], "nodes", "the default scene"), nodes, "the default scene");
}

// Depth-first with an explicit stack; a node is finished when all its children are.
class NodeWalk {
 public:
  NodeWalk(const json& nodes, std::size_t meshes) : nodes_(nodes), state_(nodes.size()), shown_(meshes) {}

  void walk(std::uint64_t root) {
    enter(root);
    while (!open_.empty()) {
      Visit& visit = open_.back();
      if (visit.next < visit.children.size())
        enter(visit.children[visit.next++]);
      else
        leave();
    }
  }

  const std::vector<bool>& shown() const { return shown_; }
  std::size_t shared() const { return shared_; }

 private:
  enum class Progress : std::uint8_t { kNew, kOpen, kDone };
  struct State {
    Progress progress = Progress::kNew;
    bool shared = false;
    double tree_size = 0;  // nodes of the tree below and with it, shared ones counted every time
  };
  struct Visit {
    std::uint64_t node = 0;
    std::vector<std::uint64_t> children;
    std::size_t next = 0;
  };

  void enter(std::uint64_t number) {
    State& state = state_[number];
    if (state.progress == Progress::kOpen)
      throw InputError("node " + std::to_string(number) + " is below itself: its nodes form a cycle");
    if (state.progress == Progress::kDone) {
      shared_ += state.shared ? 0 : 1;
      state.shared = true;
      add_to_parent(state.tree_size);
      return;
    }
    state = {Progress::kOpen, false, 1};
    const std::string where = "node " + std::to_string(number);
    if (!nodes_[number].is_object()) throw InputError(where + " is not an object");
    note_mesh(nodes_[number], where);
    open_.push_back(
        {number, node_numbers(array_of(nodes_[number], "children", where), nodes_.size(), where), 0});
  }

  void leave() {
    State& state = state_[open_.back().node];
    state.progress = Progress::kDone;
    open_.pop_back();
    add_to_parent(state.tree_size);
  }

  void add_to_parent(double tree_size) {
    double& total = open_.empty() ? forest_size_ : state_[open_.back().node].tree_size;
    total += tree_size;
    if (total > kMostNodes)
      throw InputError("its nodes share others so often that they make more than ten million");
  }

  void note_mesh(const json& node, const std::string& where) {
    if (!node.contains("mesh")) return;
    const std::uint64_t mesh = whole_number(node, "mesh", where);
    if (mesh >= shown_.size())
      throw InputError(where + " shows mesh " + std::to_string(mesh) + ", which does not exist");
    shown_[mesh] = true;
  }

  const json& nodes_;
  std::vector<State> state_;
  std::vector<bool> shown_;
  std::vector<Visit> open_;
  double forest_size_ = 0;
  std::size_t shared_ = 0;
};

}  // namespace

std::vector<bool> find_shown_meshes(const json& root, std::size_t meshes,
                                    std::vector<std::string>& warnings) {
  const json& nodes = array_of(root, "nodes", "the file");
  NodeWalk walk(nodes, meshes);
  for (const std::uint64_t number : roots_of(root, nodes.size())) walk.walk(number);
  if (walk.shared() > 0)
    warnings.push_back(std::to_string(walk.shared()) + (walk.shared() == 1 ? " node has" : " nodes have") +
                       " several parents, which glTF does not allow; what they hold counts under each");
  return walk.shown();
}

}  // namespace scene_analyzer::import
