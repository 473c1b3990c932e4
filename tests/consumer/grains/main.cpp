#include <lockstep/system_program.hpp>

#include "grains.hpp"

int main(int argc, char** argv) {
    return lockstep::run_system_program(
        argc, argv, [] { return grains::system(2000); }, grains::passes, SHADERS);
}
