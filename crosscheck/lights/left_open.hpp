#pragma once
#include <string>
#include <vector>

#include "reference/model/lights/switches.hpp"
#include "reference/model/profile.hpp"

namespace lockstep::lights {

/// Which values of switches rest on what GL leaves open and the driver does otherwise than the twins follow (rows of
/// the probe), and which values promise bits: a line each, for a report.
std::vector<std::string> left_open(const Switches& switches, const Profile& profile);

} // namespace lockstep::lights
