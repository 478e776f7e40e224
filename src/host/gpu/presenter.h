// presenter.h — Pictures in a window.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "gpu/device.h"
#include "gpu/render_target.h"

namespace scene_analyzer::gpu {

class Presenter {
 public:
  // Gets a VkInstance and returns a new VkSurfaceKHR of the window, which the Presenter destroys; 0 when
  // there is none to be had.
  using SurfaceMaker = std::function<std::uint64_t(void* instance)>;

  // `device` has to be made with DeviceOptions::surface_extensions. Throws Error when it cannot show pictures
  // in this window.
  Presenter(Device& device, const SurfaceMaker& make_surface);
  ~Presenter();
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;

  // Shows what was rendered to `picture`, stretched where it has not the window's size, and waits until it
  // was handed over. False: the window has no size at present (minimised), or changes it this very moment;
  // draw again then. Throws Error when the window's surface is lost, DeviceLost, OutOfMemory.
  bool present(const RenderTarget& picture);

  // False: present() would show nothing (minimised). Cheap. Throws as present() does.
  bool has_pixels() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace scene_analyzer::gpu
