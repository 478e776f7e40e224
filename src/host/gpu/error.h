// error.h — What can go wrong with a device. Thrown by the gpu room, caught at the faces.
#pragma once

#include <stdexcept>

namespace scene_analyzer::gpu {

class Error : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
// No device is usable, or the one asked for is not: the message lists every device and why it was refused.
class NoDevice : public Error {
  using Error::Error;
};
// An allocation failed or would exceed a limit: the message names what was needed, and the limit.
class OutOfMemory : public Error {
  using Error::Error;
};
// The device was lost (reset, unplugged, hung). Every object of the device is dead; make a new Device.
class DeviceLost : public Error {
  using Error::Error;
};

}  // namespace scene_analyzer::gpu
