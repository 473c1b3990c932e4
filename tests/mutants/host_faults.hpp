#pragma once
#include <string_view>

namespace lockstep::test {

/// A mistake of the host program, made by taking the place of GL functions in gpu/gl.hpp's table: what the host asks
/// for is changed on its way to the driver. For the lifetime of the object; one at a time, with a current context.
class HostFault {
  public:
    /// `name`: one of host_faults.cpp's; empty: none.
    explicit HostFault(std::string_view name);
    ~HostFault();
    HostFault(const HostFault&) = delete;
    HostFault& operator=(const HostFault&) = delete;
};

bool is_host_fault(std::string_view name);

} // namespace lockstep::test
