#include <catch2/catch.hpp>

#include <cstdint>

#include "reference/arithmetic.hpp"
#include "reference/portable.hpp"
#include "reference/system/item_twin.hpp"

using namespace lockstep;

/// Of an int that is the twin's own, and of the reading's.
template <class R> void keeps_signs() {
    using Int = typename R::Int;
    CHECK(item_twin::set_of(R::real(-3)).as_float() == -3.0F);
    CHECK(item_twin::set_of(R::real(Int(-3))).as_float() == -3.0F);
    CHECK(item_twin::set_of(R::real(std::uint32_t{0x80000000U})).as_float() == 2147483648.0F);
}

TEST_CASE("readings: a whole number below 0 becomes a float below 0 in each of them") {
    keeps_signs<Values<Strict>>();
    keeps_signs<Values<Portable>>();
    keeps_signs<Recording<Portable>>();
    keeps_signs<Mistaken<Strict>>();
    keeps_signs<Mistaken<Portable>>();
    keeps_signs<Mistaken<FusedProducts<Strict>>>();
    keeps_signs<Following<Strict>>();
    keeps_signs<Worlds<Strict>>();
}
