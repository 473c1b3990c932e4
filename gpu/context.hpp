#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/context_info.hpp"

namespace lockstep {

/// Which GL to open. GL libraries are opened at run time; no window or display is needed for any of them.
/// LOCKSTEP_OSMESA_LIBRARY and LOCKSTEP_EGL_LIBRARY name other builds of them than the system's.
struct ContextRequest {
    enum class Backend { automatic, osmesa, egl, egl_device };
    Backend backend = Backend::automatic;
    int device = 0; ///< egl_device: index into EGL's list of devices

    bool operator==(const ContextRequest&) const = default;
};

/// From `auto`, `osmesa`, `egl` or `egl-device:N`. Throws Error naming these for anything else.
ContextRequest parse_context_request(std::string_view text);

/// The text parse_context_request reads back.
std::string context_request_text(const ContextRequest& request);

class ContextBackend;

/// A current GL core context of version 3.3 or later, with the function table (gpu/gl.hpp) loaded for it.
/// One context is current at a time: the one made, or made current, last. GL objects die with theirs.
class Context {
  public:
    /// Throws Error with the reason if there is no such context; for `auto`, with every reason there is.
    explicit Context(const ContextRequest& request = {});
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    void make_current();
    [[nodiscard]] const ContextInfo& describe() const { return info_; }

  private:
    std::unique_ptr<ContextBackend> backend_;
    ContextInfo info_;
};

/// One of the contexts `lockstep info` lists: what it says of itself, or why there is none.
struct ContextProbe {
    ContextRequest request;
    ContextInfo info;
    std::string error; ///< empty: the context came up
};

/// Tries osmesa, egl and every EGL device, each in a child process, so that a driver that crashes or hangs is an
/// error in the list and nothing more. Call it before GL or threads are used.
std::vector<ContextProbe> available_contexts();

} // namespace lockstep
