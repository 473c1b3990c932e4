#include <lockstep/catch_main.hpp>
