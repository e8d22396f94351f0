/// The few value types that every layer shares. Cold linear algebra uses Eigen; hot loops use flat
/// columns; Vec3 is what both hand around.
#pragma once

#include <cmath>
#include <cstdint>

namespace grainbench {

/// Position of a particle, contact or facet in its column.
using Index = std::uint32_t;

/// Three Cartesian components. T is double or, inside the contact pass, a vector of lanes.
template <class T>
struct Vec3Of {
    T x{}, y{}, z{};

    constexpr Vec3Of& operator+=(const Vec3Of& other) {
        x = x + other.x;
        y = y + other.y;
        z = z + other.z;
        return *this;
    }

    constexpr Vec3Of& operator-=(const Vec3Of& other) {
        x = x - other.x;
        y = y - other.y;
        z = z - other.z;
        return *this;
    }

    friend constexpr Vec3Of operator+(const Vec3Of& a, const Vec3Of& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }

    friend constexpr Vec3Of operator-(const Vec3Of& a, const Vec3Of& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }

    friend constexpr Vec3Of operator-(const Vec3Of& a) { return {-a.x, -a.y, -a.z}; }

    friend constexpr Vec3Of operator*(const T& s, const Vec3Of& a) {
        return {s * a.x, s * a.y, s * a.z};
    }

    friend constexpr Vec3Of operator*(const Vec3Of& a, const T& s) { return s * a; }

    friend constexpr bool operator==(const Vec3Of&, const Vec3Of&) = default;
};

using Vec3 = Vec3Of<double>;

template <class T>
constexpr T dot(const Vec3Of<T>& a, const Vec3Of<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
constexpr Vec3Of<T> cross(const Vec3Of<T>& a, const Vec3Of<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double norm(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

/// a divided by its length; a itself where the length is zero.
inline Vec3 normalized(const Vec3& a) {
    const double length = norm(a);
    return length > 0.0 ? (1.0 / length) * a : a;
}

inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

inline constexpr double pi = 3.14159265358979323846;

}  // namespace grainbench
