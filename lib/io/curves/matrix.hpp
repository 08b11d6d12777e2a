// Affine maps of points, 4x4, in float64. A point is a row: p' = p * M, so that what comes first is on
// the left.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace plait {

struct Matrix {
    std::array<std::array<double, 4>, 4> m{
        {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

    bool operator==(const Matrix&) const = default;
    friend Matrix operator*(const Matrix& a, const Matrix& b) {
        Matrix c;
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = 0; j < 4; ++j) {
                c.m[i][j] = 0;
                for (size_t k = 0; k < 4; ++k)
                    c.m[i][j] += a.m[i][k] * b.m[k][j];
            }
        return c;
    }
    std::array<double, 3> operator()(double x, double y, double z) const {
        std::array<double, 3> p{};
        for (size_t j = 0; j < 3; ++j)
            p[j] = x * m[0][j] + y * m[1][j] + z * m[2][j] + m[3][j];
        return p;
    }
    // By how much it makes lengths longer, in the mean over directions.
    double scale() const {
        const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                                   m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                                   m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        return std::cbrt(std::abs(determinant));
    }
    // Of an affine map; not finite where it has none.
    Matrix inverse() const {
        Matrix r;
        const auto minor = [&](size_t i, size_t j) {
            const size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            return m[a][c] * m[b][d] - m[a][d] * m[b][c];
        };
        const double determinant =
            m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j < 3; ++j)
                r.m[i][j] = minor(j, i) / determinant;
        for (size_t j = 0; j < 3; ++j)
            r.m[3][j] = -(m[3][0] * r.m[0][j] + m[3][1] * r.m[1][j] + m[3][2] * r.m[2][j]);
        return r;
    }
    bool is_finite() const {
        for (const auto& row : m)
            for (const double value : row)
                if (!std::isfinite(value))
                    return false;
        return true;
    }
};

inline Matrix translation(double x, double y, double z) {
    Matrix t;
    t.m[3] = {x, y, z, 1};
    return t;
}

inline Matrix scaling(double x, double y, double z) {
    Matrix s;
    s.m[0][0] = x;
    s.m[1][1] = y;
    s.m[2][2] = z;
    return s;
}

// About an axis of any length but 0, counter-clockwise as seen from its tip.
inline Matrix rotation(double x, double y, double z, double degrees) {
    const double length = std::sqrt(x * x + y * y + z * z);
    Matrix r;
    if (length == 0)
        return r;
    const double n[3] = {x / length, y / length, z / length};
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            r.m[i][j] = (1 - c) * n[i] * n[j] + (i == j ? c : 0);
    r.m[0][1] += s * n[2], r.m[1][0] -= s * n[2];
    r.m[2][0] += s * n[1], r.m[0][2] -= s * n[1];
    r.m[1][2] += s * n[0], r.m[2][1] -= s * n[0];
    return r;
}

} // namespace plait
