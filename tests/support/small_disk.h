// small_disk.h — A file system in memory that is soon full, mounted over a folder as long as its object
// lives.
#pragma once

#include <sys/mount.h>

#include <filesystem>
#include <string>

namespace scene_analyzer {

class SmallDisk {
 public:
  static constexpr const char* kWhyNot = "mounting a small file system needs privileges";

  // `size` as tmpfs takes it: "64k".
  SmallDisk(std::filesystem::path folder, const std::string& size) : folder_(std::move(folder)) {
    mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);  // also when a file on it is still open
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  // From now on; false: the system does not do it.
  bool make_read_only() const {
    return ::mount(nullptr, folder_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) == 0;
  }

  bool mounted() const { return mounted_; }  // false: GTEST_SKIP() << SmallDisk::kWhyNot

 private:
  std::filesystem::path folder_;
  bool mounted_ = false;
};

}  // namespace scene_analyzer
