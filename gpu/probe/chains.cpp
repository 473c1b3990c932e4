#include <string>

#include "gpu/probe/compute_stage.hpp"
#include "gpu/probe/driver_arithmetic.hpp"
#include "gpu/probe/rows.hpp"

namespace lockstep::probing {
namespace {

constexpr std::size_t chain_inputs = 1024;

struct Chains {
    Floats scaled_twice, scaled_and_divided, divided_and_scaled; ///< three floats an input
};

/// Vectors and two factors each, a factor as often as the vector has components.
struct Inputs {
    Vectors v = random_vectors(chain_inputs, 44, {});
    Floats s = random_floats(chain_inputs, 45, {}), t = random_floats(chain_inputs, 46, {});
    [[nodiscard]] static Floats thrice(const Floats& x) {
        Floats values;
        for (const float value : x)
            values.insert(values.end(), {value, value, value});
        return values;
    }
};

Chains in_vertex_stage(const Inputs& in) {
    const VertexStage stage("probe/chains", {}, {{"a_Vector", 3}, {"a_Factors", 2}},
                            {{"out_ScaledTwice", GL_FLOAT_VEC3},
                             {"out_ScaledAndDivided", GL_FLOAT_VEC3},
                             {"out_DividedAndScaled", GL_FLOAT_VEC3}});
    const Floats vectors = flat(in.v);
    Floats factors;
    for (std::size_t i = 0; i < chain_inputs; ++i)
        factors.insert(factors.end(), {in.s[i], in.t[i]});
    const auto run = [&](std::string_view output) {
        return stage.run(chain_inputs, {{"a_Vector", 3, vectors.data()}, {"a_Factors", 2, factors.data()}}, output);
    };
    return {run("out_ScaledTwice"), run("out_ScaledAndDivided"), run("out_DividedAndScaled")};
}

Chains in_compute_stage(const Inputs& in) {
    Floats given;
    for (std::size_t i = 0; i < chain_inputs; ++i)
        given.insert(given.end(), {in.v[i].x, in.v[i].y, in.v[i].z, in.s[i], in.t[i]});
    const Floats results = ComputeStage("probe/chains").run(given, 9 * chain_inputs, chain_inputs);
    Chains chains;
    for (std::size_t i = 0; i < results.size(); ++i)
        (i % 9 < 3   ? chains.scaled_twice
         : i % 9 < 6 ? chains.scaled_and_divided
                     : chains.divided_and_scaled)
            .push_back(results[i]);
    return chains;
}

Floats products(const Floats& a, const Floats& b) {
    Floats values;
    for (std::size_t i = 0; i < a.size(); ++i)
        values.push_back(a[i] * b[i]);
    return values;
}

void judge_chains(const std::string& stage, const Chains& made, const Inputs& in, const DriverArithmetic& gl,
                  Rows& rows) {
    const Floats v = flat(in.v), s = Inputs::thrice(in.s), t = Inputs::thrice(in.t);
    rows.push_back(judge(stage + "v*s*t, in functions", made.scaled_twice,
                         {{"as written", products(products(v, s), t)},
                          {"v*(s*t)", products(v, products(s, t))},
                          {"(v*t)*s", products(products(v, t), s)}}));
    rows.push_back(judge(stage + "v*s/t, in functions", made.scaled_and_divided,
                         {{"as written", gl.divide(products(v, s), t)},
                          {"v*(s/t)", products(v, gl.divide(s, t))},
                          {"(v/t)*s", products(gl.divide(v, t), s)}}));
    rows.push_back(judge(stage + "v/s*t, in functions", made.divided_and_scaled,
                         {{"as written", products(gl.divide(v, s), t)},
                          {"v*(t/s)", products(v, gl.divide(t, s))},
                          {"v*((1/s)*t)", products(v, products(gl.reciprocal(s), t))},
                          {"(v*t)/s", gl.divide(products(v, t), s)}}));
}

} // namespace

void measure_chains(const DriverArithmetic& precise, Rows& rows) {
    const Inputs in;
    judge_chains("", in_vertex_stage(in), in, precise, rows);
}

void measure_compute_chains(const DriverArithmetic& precise, Rows& rows) {
    const Inputs in;
    judge_chains("compute: ", in_compute_stage(in), in, precise, rows);
}

} // namespace lockstep::probing
