#pragma once
#include <string>
#include <vector>

#include "reference/model/fluid/switches.hpp"
#include "reference/model/profile.hpp"

namespace lockstep::fluid {

/// Where a driver makes of points what GL does not say or what it forbids (rows of the probe), and which values of
/// switches promise bits: a line each, for a report.
std::vector<std::string> left_open(const Switches& switches, const Profile& profile);

} // namespace lockstep::fluid
