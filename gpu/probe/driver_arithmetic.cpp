#include "gpu/probe/driver_arithmetic.hpp"

#include <glm/gtc/type_ptr.hpp>

namespace lockstep::probing {
namespace {

std::vector<Attribute> attributes() {
    return {{"a_DotA", 3},    {"a_DotB", 3},      {"a_MultiplyAdd", 3},    {"a_CommonFactor", 3},
            {"a_CrossA", 3},  {"a_CrossB", 3},    {"a_Transform", 3},      {"a_TransformWritten", 3},
            {"a_Squares", 3}, {"a_Fma", 3},       {"a_Quotient", 4},       {"a_Roots", 3},
            {"a_Length", 3},  {"a_Normalize", 3}, {"a_Transcendental", 3}, {"a_Copy", 1}};
}

std::vector<Capture> outputs() {
    return {{"out_Dot", GL_FLOAT},
            {"out_MultiplyAdd", GL_FLOAT},
            {"out_CommonFactor", GL_FLOAT},
            {"out_Cross", GL_FLOAT_VEC3},
            {"out_Transform", GL_FLOAT_VEC4},
            {"out_TransformWritten", GL_FLOAT_VEC4},
            {"out_Squares", GL_FLOAT},
            {"out_Fma", GL_FLOAT},
            {"out_Quotient", GL_FLOAT},
            {"out_ByConstants", GL_FLOAT_VEC4},
            {"out_Reciprocal", GL_FLOAT},
            {"out_Sqrt", GL_FLOAT},
            {"out_InverseSqrt", GL_FLOAT},
            {"out_Length", GL_FLOAT},
            {"out_Normalize", GL_FLOAT_VEC3},
            {"out_Transcendental", GL_FLOAT_VEC3},
            {"out_Copy", GL_FLOAT},
            {"out_Positive", GL_FLOAT}};
}

const float* data(const Vectors& v) { return glm::value_ptr(v.front()); }

} // namespace

DriverArithmetic::DriverArithmetic(bool precise)
    : stage_("probe/arithmetic", {{"PRECISE", precise ? "precise" : ""}}, attributes(), outputs()) {}

Floats DriverArithmetic::of_vectors(std::string_view attribute, const Vectors& v, std::string_view output) const {
    return stage_.run(v.size(), {{attribute, 3, data(v)}}, output);
}

Floats DriverArithmetic::root(int component, const Floats& x, std::string_view output) const {
    Vectors v(x.size(), glm::vec3(1.0F));
    for (std::size_t i = 0; i < x.size(); ++i)
        v[i][component] = x[i];
    return of_vectors("a_Roots", v, output);
}

Floats DriverArithmetic::dot(const Vectors& a, const Vectors& b) const {
    return stage_.run(a.size(), {{"a_DotA", 3, data(a)}, {"a_DotB", 3, data(b)}}, "out_Dot");
}

Floats DriverArithmetic::cross(const Vectors& a, const Vectors& b) const {
    return stage_.run(a.size(), {{"a_CrossA", 3, data(a)}, {"a_CrossB", 3, data(b)}}, "out_Cross");
}

Floats DriverArithmetic::multiply_add(const Vectors& v) const {
    return of_vectors("a_MultiplyAdd", v, "out_MultiplyAdd");
}

Floats DriverArithmetic::fma(const Vectors& v) const { return of_vectors("a_Fma", v, "out_Fma"); }

Floats DriverArithmetic::common_factor(const Vectors& v) const {
    return of_vectors("a_CommonFactor", v, "out_CommonFactor");
}

Floats DriverArithmetic::squares(const Vectors& v) const { return of_vectors("a_Squares", v, "out_Squares"); }

Floats DriverArithmetic::transform(const glm::mat4& m, const Vectors& v) const {
    stage_.program().set("u_Matrix", m);
    return of_vectors("a_Transform", v, "out_Transform");
}

Floats DriverArithmetic::transform_written(const glm::mat4& m, const Vectors& v) const {
    stage_.program().set("u_Matrix", m);
    return of_vectors("a_TransformWritten", v, "out_TransformWritten");
}

Floats DriverArithmetic::divide(const Floats& a, const Floats& b) const {
    Floats given(a.size() * 4, 1.0F);
    for (std::size_t i = 0; i < a.size(); ++i) {
        given[4 * i] = a[i];
        given[4 * i + 1] = b[i];
    }
    return stage_.run(a.size(), {{"a_Quotient", 4, given.data()}}, "out_Quotient");
}

Floats DriverArithmetic::by_constants(const Floats& a) const {
    return stage_.run(a.size() / 4, {{"a_Quotient", 4, a.data()}}, "out_ByConstants");
}

Floats DriverArithmetic::reciprocal(const Floats& x) const { return root(0, x, "out_Reciprocal"); }
Floats DriverArithmetic::sqrt(const Floats& x) const { return root(1, x, "out_Sqrt"); }
Floats DriverArithmetic::inverse_sqrt(const Floats& x) const { return root(2, x, "out_InverseSqrt"); }

Floats DriverArithmetic::length(const Vectors& v) const { return of_vectors("a_Length", v, "out_Length"); }
Floats DriverArithmetic::normalize(const Vectors& v) const { return of_vectors("a_Normalize", v, "out_Normalize"); }

Floats DriverArithmetic::transcendental(const Vectors& v) const {
    return of_vectors("a_Transcendental", v, "out_Transcendental");
}

Floats DriverArithmetic::copy(const Floats& x) const {
    return stage_.run(x.size(), {{"a_Copy", 1, x.data()}}, "out_Copy");
}

Floats DriverArithmetic::positive(const Floats& x) const {
    return stage_.run(x.size(), {{"a_Copy", 1, x.data()}}, "out_Positive");
}

} // namespace lockstep::probing
