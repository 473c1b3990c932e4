#pragma once

namespace lockstep {

/// While one lives, every shader file is read once, or found missing once: a run, its report and its capsule are of the
/// same text, whatever is saved meanwhile. At most one at a time.
class ShadersReadOnce {
  public:
    ShadersReadOnce();
    ~ShadersReadOnce();
    ShadersReadOnce(const ShadersReadOnce&) = delete;
    ShadersReadOnce& operator=(const ShadersReadOnce&) = delete;
};

} // namespace lockstep
