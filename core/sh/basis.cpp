// Real spherical harmonics in Cartesian form: each value is a polynomial in z times Re or Im (x + iy)^m, so that no
// angle is needed and the poles are regular. Recurrence: Holmes and Featherstone, "A unified approach to the Clenshaw
// summation and the recursive computation of very high degree and order normalised associated Legendre functions", J.
// Geodesy 2002. Shared factors of the low orders: Sloan, "Efficient Spherical Harmonic Evaluation", JCGT 2013.
#include "sh/basis.h"

#include <array>
#include <cmath>

#include "sh/check.h"

namespace shbake::sh {
namespace {

/// Orders whose recurrence factors are tabulated; above it each costs two square roots.
constexpr int kTableOrder = 33;
/// Orders that the polynomials cover: below 7 they are 2 to 4 times as fast as the recurrence.
constexpr int kPolynomialOrder = 6;

/// sqrt for constant expressions, to the last bit or the one beside it, for x >= 0.
constexpr double constantSqrt(double x) {
  if (x == 0) return 0;
  double root = x > 1 ? x : 1;
  for (double next = (root + x / root) / 2; next < root; next = (root + x / root) / 2) root = next;
  return root;
}

struct Factors {
  double a, b;
};

// The squares of the factors in q_lm = a (z q_{l-1,m} - b r^2 q_{l-2,m}), maths.md (3).
constexpr double aSquared(double l, double m) {
  return (4 * l * l - 1) / (l * l - m * m);
}
constexpr double bSquared(double l, double m) {
  return ((l - 1) * (l - 1) - m * m) / (4 * (l - 1) * (l - 1) - 1);
}

constexpr std::size_t tableIndex(int l, int m) {
  return static_cast<std::size_t>(l * (l - 1) / 2 + m);
}

constexpr auto makeTable() {
  std::array<Factors, kTableOrder*(kTableOrder - 1) / 2> table{};
  for (int l = 1; l < kTableOrder; ++l) {
    for (int m = 0; m < l; ++m) {
      const double b = l > 1 ? constantSqrt(bSquared(l, m)) : 0;
      table[tableIndex(l, m)] = {constantSqrt(aSquared(l, m)), b};
    }
  }
  return table;
}
constexpr auto kTable = makeTable();

Factors factors(int l, int m) {
  if (l < kTableOrder) return kTable[tableIndex(l, m)];
  return {std::sqrt(aSquared(l, m)), std::sqrt(bSquared(l, m))};
}

constexpr double kY00 = 0.28209479177387814347;  // 1 / sqrt(4 pi)
constexpr double kSqrt2 = 1.41421356237309504880;

/// All bands, order by order m: q_lm rises in l from q_mm, and cosine and sine parts are (x + iy)^m.
template <class Out>
void recurrence(int order, const Vec3d& d, Out* out) {
  // Written as homogeneous polynomials, degree l magnifies a rounding error in the length of d by l and not by l^2.
  const double rr = dot(d, d);
  double cosine = 1, sine = 0, diagonal = kY00;
  for (int m = 0; m < order; ++m) {
    if (m > 0) {
      const double c = d.x * cosine - d.y * sine;
      sine = d.x * sine + d.y * cosine;
      cosine = c;
      diagonal *= std::sqrt((2.0 * m + 1) / (2.0 * m)) * (m == 1 ? kSqrt2 : 1);
    }
    double before = 0, value = diagonal;
    for (int l = m; l < order; ++l) {
      if (l > m) {
        const Factors f = factors(l, m);
        const double next = f.a * (d.z * value - f.b * rr * before);
        before = value;
        value = next;
      }
      out[index(l, -m)] = static_cast<Out>(value * sine);
      out[index(l, m)] = static_cast<Out>(value * cosine);
    }
  }
}

// maths.md (2) written out. The literals are exact to the last bit of a double.

/// Degrees 4 and 5, with (x + iy)^3 = c3 + i s3 known.
template <class T>
void upperPolynomials(int order, const Vec3<T>& d, T c3, T s3, T* out) {
  const T x = d.x, y = d.y, z = d.z, zz = z * z, c2 = x * x - y * y, s2 = T(2) * x * y;
  const T c4 = x * c3 - y * s3, s4 = x * s3 + y * c3;
  const T q41 = z * (T(4.683325804901024) * zz - T(2.0071396306718676));
  const T q42 = T(3.3116114351514603) * zz - T(0.47308734787878);
  const T q43 = T(1.7701307697799304) * z;
  constexpr T q44 = T(0.6258357354491761);
  out[16] = q44 * s4;
  out[17] = q43 * s3;
  out[18] = q42 * s2;
  out[19] = q41 * y;
  out[20] = zz * (T(3.7024941420321507) * zz - T(3.173566407456129)) + T(0.31735664074561293);
  out[21] = q41 * x;
  out[22] = q42 * c2;
  out[23] = q43 * c3;
  out[24] = q44 * c4;
  if (order == 5) return;

  const T c5 = x * c4 - y * s4, s5 = x * s4 + y * c4;
  const T q51 = zz * (T(9.511879675109636) * zz - T(6.341253116739757)) + T(0.45294665119569694);
  const T q52 = z * (T(7.190305177459986) * zz - T(2.396768392486662));
  const T q53 = T(4.403144694917254) * zz - T(0.4892382994352504);
  const T q54 = T(2.075662314881041) * z;
  constexpr T q55 = T(0.6563820568401701);
  out[25] = q55 * s5;
  out[26] = q54 * s4;
  out[27] = q53 * s3;
  out[28] = q52 * s2;
  out[29] = q51 * y;
  out[30] = z * (zz * (T(7.367870314565686) * zz - T(8.186522571739651)) + T(1.754254836801354));
  out[31] = q51 * x;
  out[32] = q52 * c2;
  out[33] = q53 * c3;
  out[34] = q54 * c4;
  out[35] = q55 * c5;
}

/// Degrees 0 to 5.
template <class T>
void polynomials(int order, const Vec3<T>& d, T* out) {
  const T x = d.x, y = d.y, z = d.z;
  out[0] = T(0.28209479177387814);
  if (order == 1) return;

  constexpr T k1 = T(0.4886025119029199);
  out[1] = k1 * y;
  out[2] = k1 * z;
  out[3] = k1 * x;
  if (order == 2) return;

  const T zz = z * z, c2 = x * x - y * y, s2 = T(2) * x * y;
  const T q21 = T(1.0925484305920792) * z;
  constexpr T q22 = T(0.5462742152960396);
  out[4] = q22 * s2;
  out[5] = q21 * y;
  out[6] = T(0.94617469575756) * zz - T(0.31539156525252);
  out[7] = q21 * x;
  out[8] = q22 * c2;
  if (order == 3) return;

  const T c3 = x * c2 - y * s2, s3 = x * s2 + y * c2;
  const T q31 = T(2.2852289973223288) * zz - T(0.4570457994644657);
  const T q32 = T(1.4453057213202771) * z;
  constexpr T q33 = T(0.5900435899266435);
  out[9] = q33 * s3;
  out[10] = q32 * s2;
  out[11] = q31 * y;
  out[12] = z * (T(1.865881662950577) * zz - T(1.1195289977703462));
  out[13] = q31 * x;
  out[14] = q32 * c2;
  out[15] = q33 * c3;
  if (order == 4) return;

  upperPolynomials(order, d, c3, s3, out);
}

template <class T>
void evaluateAny(int order, const Vec3<T>& direction, std::span<T> out) {
  requireOrder(order, 1, kMaxBasisOrder, "spherical harmonics");
  requireCoefficients(order, out.size(), "the output of evaluate()");
  if (order <= kPolynomialOrder) {
    polynomials(order, direction, out.data());
  } else {
    recurrence(order, Vec3d(direction), out.data());
  }
}

}  // namespace

void evaluate(int order, const Vec3d& direction, std::span<double> out) {
  evaluateAny(order, direction, out);
}

void evaluate(int order, const Vec3f& direction, std::span<float> out) {
  evaluateAny(order, direction, out);
}

void oracle::evaluateByRecurrence(int order, const Vec3d& direction, std::span<double> out) {
  requireOrder(order, 1, kMaxBasisOrder, "spherical harmonics");
  requireCoefficients(order, out.size(), "the output of evaluateByRecurrence()");
  recurrence(order, direction, out.data());
}

}  // namespace shbake::sh
