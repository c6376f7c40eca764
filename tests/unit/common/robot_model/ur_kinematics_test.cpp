#include "common/robot_model/ur_kinematics.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/data_dir.h"

namespace kiln {
namespace {

Vector6d randomJoints(std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  Vector6d q;
  for (int i = 0; i < 6; ++i) q[i] = angle(random);
  return q;
}

TEST(UrKinematics, StretchedOutReachesTheSumOfItsLinks) {
  // All joints zero: the arm lies along -X; wrist offsets point to -Y, the last but one link down.
  const Eigen::Isometry3d X = UrKinematics::ur10e().forward(Vector6d::Zero());
  EXPECT_NEAR(X.translation().x(), -(0.6127 + 0.57155), 1e-12);
  EXPECT_NEAR(X.translation().y(), -(0.17415 + 0.11655), 1e-12);
  EXPECT_NEAR(X.translation().z(), 0.1807 - 0.11985, 1e-12);
  EXPECT_TRUE(X.linear().col(2).isApprox(-Eigen::Vector3d::UnitY(), 1e-12)) << "flange Z";
}

TEST(UrKinematics, TheLastFrameIsTheFlange) {
  std::mt19937 random(1);
  const UrKinematics arm = UrKinematics::ur10e();
  for (int i = 0; i < 50; ++i) {
    const Vector6d q = randomJoints(random);
    EXPECT_TRUE(arm.frames(q)[5].isApprox(arm.forward(q), 1e-15));
    EXPECT_NEAR(arm.forward(q).linear().determinant(), 1.0, 1e-9);
  }
}

TEST(UrKinematics, JacobianAgreesWithFiniteDifferences) {
  std::mt19937 random(2);
  const UrKinematics arm = UrKinematics::ur10e();
  constexpr double h = 1e-6;
  for (int sample = 0; sample < 50; ++sample) {
    const Vector6d q = randomJoints(random);
    const auto J = arm.jacobian(q);
    for (int i = 0; i < 6; ++i) {
      Vector6d plus = q, minus = q;
      plus[i] += h;
      minus[i] -= h;
      const Eigen::Isometry3d a = arm.forward(minus), b = arm.forward(plus);
      const Eigen::Vector3d linear = (b.translation() - a.translation()) / (2 * h);
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(b.linear() * a.linear().transpose()));
      const Eigen::Vector3d angular = turn.axis() * turn.angle() / (2 * h);
      EXPECT_TRUE((J.block<3, 1>(0, i) - linear).norm() < 1e-6) << "joint " << i;
      EXPECT_TRUE((J.block<3, 1>(3, i) - angular).norm() < 1e-6) << "joint " << i;
    }
  }
}

/// Big-endian double at `offset`.
double doubleAt(const std::vector<unsigned char>& bytes, std::size_t offset) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i) bits = bits << 8 | bytes.at(offset + i);
  return std::bit_cast<double>(bits);
}

/// Offset of a sub-packet of the primary robot state: uint32 length, uint8 type (hardware.md 1.2).
std::size_t subPacket(const std::vector<unsigned char>& bytes, unsigned type) {
  for (std::size_t at = 5; at + 5 <= bytes.size();) {
    if (bytes[at + 4] == type) return at;
    at += bytes[at] << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
  }
  ADD_FAILURE() << "no sub-packet of type " << type;
  return 0;
}

TEST(UrKinematics, AgreesWithTheVendorsControllerOnARealPacket) {
  const auto file = testing::dataFile("ur_packets/primary_robot_state.bin");
  if (!file) GTEST_SKIP() << "no captures here: set KILN_DATA_DIR";
  std::ifstream in(*file, std::ios::binary);
  const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(in)), {});
  // The packet is a UR5e's: same chain, its own lengths.
  UrKinematics ur5e = UrKinematics::ur10e();
  ur5e.a = {0.0, -0.425, -0.3922, 0.0, 0.0, 0.0};
  ur5e.d = {0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996};
  Vector6d q, tcp;
  const std::size_t joints = subPacket(bytes, 1), cartesian = subPacket(bytes, 4);
  for (std::size_t i = 0; i < 6; ++i) {
    q[static_cast<Eigen::Index>(i)] = doubleAt(bytes, joints + 5 + 41 * i);
    tcp[static_cast<Eigen::Index>(i)] = doubleAt(bytes, cartesian + 5 + 8 * i);
    ASSERT_EQ(doubleAt(bytes, cartesian + 5 + 48 + 8 * i), 0.0) << "the flange itself is reported";
  }
  const Eigen::Isometry3d X = ur5e.forward(q);
  EXPECT_LT((X.translation() - tcp.head<3>()).norm(), 1e-9);
  const Eigen::AngleAxisd reported(tcp.tail<3>().norm(), tcp.tail<3>().normalized());
  EXPECT_TRUE(X.linear().isApprox(reported.toRotationMatrix(), 1e-9));
}

}  // namespace
}  // namespace kiln
