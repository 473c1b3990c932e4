// Exponentials and powers: the driver's, or with the same bits everywhere. Needs rounding.glsl.

#if TRANSCENDENTALS == TRANSCENDENTALS_PORTABLE

// exp(x) of x <= 0: the nearest float, or one beside it; 0 below -87.
float exp_of(float x) {
    if (!(x >= -87.0))
        return 0.0;
    float j = floor(add(mul(x, 1.44269504), 0.5));
    float q = sub(sub(x, mul(j, 0.693359375)), mul(j, -2.12194440e-4)); // x - j ln 2
    float p = 0.0013941169;
    p = add(mul(p, q), 0.00837517437);
    p = add(mul(p, q), 0.0416663513);
    p = add(mul(p, q), 0.166664153);
    p = add(mul(p, q), 0.5);
    p = add(mul(p, q), 1.0);
    p = add(mul(p, q), 1.0);
    return intBitsToFloat(floatBitsToInt(p) + (int(j) << 23));
}

// x^n by squares of squares, the largest first.
float power(float x, int n) {
    float squares[10]; // n < 1024
    int top = findMSB(n);
    squares[0] = x;
    for (int i = 1; i <= top; ++i)
        squares[i] = mul(squares[i - 1], squares[i - 1]);
    float product = squares[top];
    for (int i = top - 1; i >= 0; --i)
        if ((n >> i & 1) != 0)
            product = mul(product, squares[i]);
    return product;
}

#else

float exp_of(float x) {
    precise float y = exp(x);
    return y;
}

float power(float x, int n) {
    precise float y = pow(x, float(n));
    return y;
}

#endif
