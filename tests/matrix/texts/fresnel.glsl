float fresnel(float c) { return 0.04 + 0.96 * pow(1.0 - c, 5.0); }

float by_products(float c) {
    float d = 1.0 - c;
    return 0.04 + 0.96 * (d * d * d * d * d);
}

float a_power_too_few(float c) {
    float d = 1.0 - c;
    return 0.04 + 0.96 * (d * d * d * d);
}

float of_any_base(float c, float power) { return pow(c, power); }
