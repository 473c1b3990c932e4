#pragma once
#include <array>
#include <cstddef>
#include <mutex>

namespace lockstep::lights {

/// Values that mistakes ask for, each made when it is first asked for. Any number of threads may ask.
template <class T, std::size_t count> class MadeOnAsking {
  public:
    template <class Make> const T& of(std::size_t which, const Make& make) const {
        Made& made = all_[which];
        std::call_once(made.once, [&] { made.value = make(); });
        return made.value;
    }

  private:
    struct Made {
        std::once_flag once;
        T value;
    };
    mutable std::array<Made, count> all_;
};

} // namespace lockstep::lights
