#include "castor/mapping/localisation/particles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace castor::mapping {

namespace {

using std::numbers::pi;

TEST(ParticleClusters, MostProbableIsFirst) {
  auto clusters = clusters_of(
    {{{0, 0, 0}, 0.1}, {{5, 5, 0}, 0.3}, {{5.2, 5, 0}, 0.3}, {{0.1, 0, 0}, 0.2}, {{5, 5, 2}, 0.1}});
  ASSERT_EQ(clusters.size(), 3U);
  EXPECT_NEAR(clusters[0].weight, 0.6, 1e-12);
  EXPECT_NEAR(clusters[0].mean.x, 5.1, 1e-12);
  EXPECT_NEAR(clusters[0].covariance.xx, 0.01, 1e-12);
  EXPECT_NEAR(clusters[0].spread(), 0.1, 1e-12);
  EXPECT_NEAR(clusters[1].weight, 0.3, 1e-12);
  EXPECT_NEAR(clusters[2].weight, 0.1, 1e-12);
}

TEST(ParticleClusters, HeadingsAroundHalfATurnAreNear) {
  auto clusters = clusters_of({{{0, 0, pi - 0.1}, 0.5}, {{0, 0, -pi + 0.1}, 0.5}});
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_NEAR(std::abs(clusters[0].mean.heading), pi, 1e-9);
  EXPECT_NEAR(clusters[0].covariance.heading, 0.01, 1e-9);
}

TEST(ParticleClusters, AChainOfParticlesIsOne) {
  std::vector<Particle> chain;
  for (int i = 0; i < 20; ++i)
    chain.push_back({{-3 + 0.3 * i, 0, 0}, 0.05});
  auto clusters = clusters_of(chain);
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_NEAR(clusters[0].weight, 1, 1e-12);
}

TEST(ParticleClusters, NoParticlesAreNoCluster) {
  EXPECT_TRUE(clusters_of({}).empty());
}

} // namespace

} // namespace castor::mapping
