"""portable_math in Python alone, for planners that run without the extension: avoidbench/portable_math.hpp line by
line, to the last bit.

Minimax polynomials and argument reductions of FDLIBM 5.3: Copyright (C) 1993 by Sun Microsystems, Inc. All rights
reserved. Developed at SunSoft, a Sun Microsystems, Inc. business. Permission to use, copy, modify, and distribute this
software is freely granted, provided that this notice is preserved."""

import math
import struct

_PI = 3.14159265358979323846
_NAN, _INFINITY = math.nan, math.inf


def _kernel_sin(x: float, tail: float) -> float:
    z = x * x
    v = z * x
    r = 8.33333333332248946124e-03 + z * (
        -1.98412698298579493134e-04
        + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))
    )
    return x - ((z * (0.5 * tail - v * r) - tail) - v * -1.66666666666666324348e-01)


def _kernel_cos(x: float, tail: float) -> float:
    z = x * x
    r = z * (
        4.16666666666666019037e-02
        + z
        * (
            -1.38888888888741095749e-03
            + z
            * (
                2.48015872894767294178e-05
                + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))
            )
        )
    )
    half = 0.5 * z
    w = 1.0 - half
    return w + (((1.0 - w) - half) + (z * r - x * tail))


def _exponent(x: float) -> int:
    bits: int = struct.unpack("<Q", struct.pack("<d", x))[0]
    return bits >> 52 & 0x7FF


def _reduce(x: float) -> tuple[float, float, int]:
    n = float(round(x * 6.36619772367581382433e-01))
    r = x - n * 1.57079632673412561417e00
    w = n * 6.07710050650619224932e-11
    y = r - w
    exponent = _exponent(x)
    if exponent - _exponent(y) > 16:
        t = r
        w = n * 6.07710050630396597660e-11
        r = t - w
        w = n * 2.02226624879595063154e-21 - ((t - r) - w)
        y = r - w
        if exponent - _exponent(y) > 49:
            t = r
            w = n * 2.02226624871116645580e-21
            r = t - w
            w = n * 8.47842766036889956997e-32 - ((t - r) - w)
            y = r - w
    return y, (r - y) - w, int(n) & 3


def sin(x: float) -> float:
    x = float(x)
    if abs(x) <= _PI / 4:
        return _kernel_sin(x, 0.0)
    if not abs(x) <= 1e6:
        return _NAN
    y, tail, quadrant = _reduce(x)
    value = _kernel_cos(y, tail) if quadrant & 1 else _kernel_sin(y, tail)
    return -value if quadrant & 2 else value


def cos(x: float) -> float:
    x = float(x)
    if abs(x) <= _PI / 4:
        return _kernel_cos(x, 0.0)
    if not abs(x) <= 1e6:
        return _NAN
    y, tail, quadrant = _reduce(x)
    value = _kernel_sin(y, tail) if quadrant & 1 else _kernel_cos(y, tail)
    return -value if quadrant in (1, 2) else value


def _over(a: float, b: float) -> float:
    """a / b as in IEEE 754."""
    if b != 0.0:
        return a / b
    return _NAN if a == 0.0 or math.isnan(a) else math.copysign(_INFINITY, a) * math.copysign(1.0, b)


def tan(x: float) -> float:
    return _over(sin(x), cos(x))


_HIGH = (4.63647609000806093515e-01, 7.85398163397448278999e-01, 9.82793723247329054082e-01, 1.57079632679489655800e00)
_LOW = (2.26987774529616870924e-17, 3.06161699786838301793e-17, 1.39033110312309984516e-17, 6.12323399573676603587e-17)


def atan(x: float) -> float:
    x = float(x)
    if math.isnan(x):
        return x
    size = abs(x)
    if size >= 2.0**66:
        return math.copysign(_HIGH[3] + _LOW[3], x)
    part, y = -1, size
    if size >= 2.4375:
        part, y = 3, -1.0 / size
    elif size >= 1.1875:
        part, y = 2, (size - 1.5) / (1.0 + 1.5 * size)
    elif size >= 0.6875:
        part, y = 1, (size - 1.0) / (size + 1.0)
    elif size >= 0.4375:
        part, y = 0, (2.0 * size - 1.0) / (2.0 + size)
    z = y * y
    w = z * z
    odd = z * (
        3.33333333333329318027e-01
        + w
        * (
            1.42857142725034663711e-01
            + w
            * (
                9.09088713343650656196e-02
                + w * (6.66107313738753120669e-02 + w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02))
            )
        )
    )
    even = w * (
        -1.99999999998764832476e-01
        + w
        * (
            -1.11111104054623557880e-01
            + w * (-7.69187620504482999495e-02 + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))
        )
    )
    value = y - y * (odd + even) if part < 0 else _HIGH[part] - ((y * (odd + even) - _LOW[part]) - y)
    return math.copysign(value, x)


def atan2(y: float, x: float) -> float:
    y, x = float(y), float(x)
    if math.isnan(x) or math.isnan(y):
        return _NAN
    if y == 0.0:
        return math.copysign(_PI, y) if math.copysign(1.0, x) < 0.0 else y
    if x == 0.0:
        return math.copysign(_PI / 2, y)
    if math.isinf(x) or math.isinf(y):
        toward_x = (0.0 if x > 0 else _PI) if math.isinf(x) else _PI / 2
        both = _PI / 4 if x > 0 else 3 * (_PI / 4)
        return math.copysign(both if math.isinf(x) and math.isinf(y) else toward_x, y)
    angle = atan(abs(y / x))
    return math.copysign(angle if x > 0 else _PI - (angle - 1.2246467991473531772e-16), y)


def _root(x: float) -> float:
    return math.sqrt(x) if x >= 0.0 else _NAN


def asin(x: float) -> float:
    return atan2(x, _root((1.0 - x) * (1.0 + x)))


def acos(x: float) -> float:
    return atan2(_root((1.0 - x) * (1.0 + x)), x)


def exp(x: float) -> float:
    x = float(x)
    if math.isnan(x):
        return x
    if x > 7.09782712893383973096e02:
        return _INFINITY
    if x < -7.45133219101941108420e02:
        return 0.0
    k = float(round(x * 1.44269504088896338700)) if abs(x) > 0.34657359027997264 else 0.0
    high = x - k * 6.93147180369123816490e-01
    low = k * 1.90821492927058770002e-10
    r = high - low
    t = r * r
    c = r - t * (
        1.66666666666666019037e-01
        + t
        * (
            -2.77777777770155933842e-03
            + t * (6.61375632143793436117e-05 + t * (-1.65339022054652515390e-06 + t * 4.13813679705723846039e-08))
        )
    )
    return math.ldexp(1.0 - ((low - (r * c) / (2.0 - c)) - high), int(k))


def log(x: float) -> float:
    x = float(x)
    if math.isnan(x) or x < 0.0:
        return _NAN
    if x == 0.0:
        return -_INFINITY
    if math.isinf(x):
        return x
    m, k = math.frexp(x)
    if m < 0.70710678118654752440:
        m *= 2.0
        k -= 1
    f = m - 1.0
    s = f / (2.0 + f)
    z = s * s
    w = z * z
    even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01))
    odd = z * (
        6.666666666666735130e-01
        + w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01))
    )
    half_square = 0.5 * f * f
    n = float(k)
    return n * 6.93147180369123816490e-01 - (
        (half_square - (s * (half_square + even + odd) + n * 1.90821492927058770002e-10)) - f
    )
