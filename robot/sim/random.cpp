#include "robot/sim/random.h"

#include <bit>
#include <cmath>
#include <vector>

namespace kiln::sim {
namespace {

constexpr std::size_t kQuantiles = 1u << 14;

double inverseNormal(double p) {
  double x =
      0.0;  // Newton on the normal distribution function; p is never nearer to 0 or 1 than 3e-5
  for (int i = 0; i < 60; ++i) {
    const double cdf = 0.5 * std::erfc(-x / M_SQRT2);
    const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * M_PI);
    const double step = (cdf - p) / density;
    x -= std::fmax(-0.5, std::fmin(0.5, step));
    if (std::fabs(step) < 1e-12) break;
  }
  return x;
}

const std::vector<float>& quantiles() {
  static const std::vector<float> table = [] {
    std::vector<float> out(kQuantiles);
    for (std::size_t i = 0; i < kQuantiles; ++i) {
      out[i] = static_cast<float>(inverseNormal((static_cast<double>(i) + 0.5) / kQuantiles));
    }
    return out;
  }();
  return table;
}

std::uint64_t splitMix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(std::uint64_t seed, std::string_view purpose) {
  std::uint64_t state = 0xcbf29ce484222325ULL;  // FNV-1a of the purpose
  for (const char c : purpose) state = (state ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  state ^= seed * 0x9e3779b97f4a7c15ULL;
  for (std::uint64_t& s : s_) s = splitMix(state);
}

std::uint64_t Random::bits() {
  const std::uint64_t result = std::rotl(s_[1] * 5, 7) * 9;
  const std::uint64_t t = s_[1] << 17;
  s_[2] ^= s_[0];
  s_[3] ^= s_[1];
  s_[1] ^= s_[2];
  s_[0] ^= s_[3];
  s_[2] ^= t;
  s_[3] = std::rotl(s_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

float Random::normal() {
  static const float* const table = quantiles().data();
  return table[bits() >> 50];
}

}  // namespace kiln::sim
