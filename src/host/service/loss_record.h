// loss_record.h — Assets that the device was lost with.
//
// A client that is told UNAVAILABLE tries again, and an asset that a driver cannot bear would take the device
// from everybody again and again. By the contents of the asset's own file, whatever it is called.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <utility>

#include "mesh/asset_source.h"

namespace scene_analyzer::service {

class LossRecord {
 public:
  // The device was lost while nothing but `asset` was on it. Throws InputError for a file that is gone.
  void add(const mesh::AssetSource& asset);
  // Throws Refusal for an asset of which that is known twice. Cost: one pass over its file, once there is
  // any of which that is known.
  void check(const mesh::AssetSource& asset) const;
  // How many assets check() has ever come to refuse: where that is what it was, there is no need to check
  // again.
  std::uint64_t refused() const;

 private:
  struct Loss {
    std::pair<std::uint64_t, std::uint64_t> contents;
    int times = 0;
  };

  mutable std::mutex mutex_;
  std::deque<Loss> losses_;  // the oldest first
  std::uint64_t refused_ = 0;
};

}  // namespace scene_analyzer::service
