#include "reference/text/text_machine.hpp"

#include "reference/text/glsl_functions.hpp"
#include "reference/text/machine_flow.hpp"
#include "reference/text/machine_memory.hpp"

namespace lockstep::text {

template class Machine<TextValues, lanes_at_once>;

} // namespace lockstep::text
