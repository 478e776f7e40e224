// worst.h — The first few of very many, in their order, without holding all of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace scene_analyzer::gate {

// T has operator<, a strict order in which no two that are added are equal. Cost of add(): log of the
// capacity.
template <typename T>
class Worst {
 public:
  explicit Worst(std::size_t capacity) : capacity_(capacity) {}

  void add(const T& one) {
    if (capacity_ == 0) return;
    if (heap_.size() == capacity_) {
      if (!(one < heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.back() = one;
    } else {
      heap_.push_back(one);
    }
    std::push_heap(heap_.begin(), heap_.end());
  }

  // Ascending; nothing is left.
  std::vector<T> take() {
    std::sort_heap(heap_.begin(), heap_.end());
    return std::move(heap_);
  }

 private:
  std::size_t capacity_;
  std::vector<T> heap_;  // the last of them on top
};

}  // namespace scene_analyzer::gate
