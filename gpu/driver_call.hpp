#pragma once
#include <atomic>

namespace lockstep {

/// A call into the driver that is under way. The whole process has one at most; signal handlers ask for it.
class DriverCall {
  public:
    /// `name`: of static life, as a message has it: "glLinkProgram".
    explicit DriverCall(const char* name) noexcept : before_(running_.exchange(name, std::memory_order_relaxed)) {}
    ~DriverCall() { running_.store(before_, std::memory_order_relaxed); }
    DriverCall(const DriverCall&) = delete;
    DriverCall& operator=(const DriverCall&) = delete;

    /// Null: none.
    static const char* running() noexcept { return running_.load(std::memory_order_relaxed); }

  private:
    static inline std::atomic<const char*> running_{nullptr};
    const char* before_;
};

} // namespace lockstep
