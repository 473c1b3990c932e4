#include "reference/model/dust/schema.hpp"

namespace lockstep::dust {

const Schema& schema() {
    static const Schema all =
        checked({"dust",
                 {{.name = "grains",
                   .item = "grain",
                   .title = "the grains",
                   .fields = {{.name = "position", .components = 3, .unit = "m", .block = "dustBuffer"},
                              {.name = "alive", .scalar = Scalar::int32, .block = "dustBuffer"},
                              {.name = "velocity", .components = 3, .unit = "m/s", .block = "velocityBuffer"},
                              {.name = "colour", .components = 3, .block = "dustColorBuffer"}}},
                  {.name = "count",
                   .item = "count",
                   .title = "the count",
                   .fields = {{.name = "alive_number", .scalar = Scalar::uint32, .block = "aliveNumberBuffer"}}}}});
    return all;
}

} // namespace lockstep::dust
