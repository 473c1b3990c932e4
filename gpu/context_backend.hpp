#pragma once
#include <array>
#include <memory>
#include <string>
#include <utility>

namespace lockstep {

/// What a kind of context has to do; the rest is Context's. Made without being current.
class ContextBackend {
  public:
    ContextBackend() = default;
    ContextBackend(const ContextBackend&) = delete;
    ContextBackend& operator=(const ContextBackend&) = delete;
    virtual ~ContextBackend() = default;

    virtual void make_current() = 0;
    virtual void release() = 0; ///< afterwards no context of this library is current
    virtual void* resolve(const char* name) = 0;
};

/// GL versions asked for, newest first. 4.5 is the newest with something of use here (clip control).
inline constexpr std::array<std::pair<int, int>, 4> context_versions{{{4, 5}, {4, 3}, {4, 0}, {3, 3}}};

// Each throws Error with the reason if it has no context to give.
std::unique_ptr<ContextBackend> make_osmesa_context();
std::unique_ptr<ContextBackend> make_egl_surfaceless_context();
std::unique_ptr<ContextBackend> make_egl_device_context(int device);

/// Number of EGL devices; 0 without EGL or without its device extensions.
int egl_device_count();

/// Whether a device is more than a software rasteriser.
bool egl_device_is_hardware(int device);

} // namespace lockstep
