#include <ceres/ceres.h>

#include "common/core/check.h"
#include "robot/perception/bricks/block_cost.h"
#include "robot/perception/bricks/brick_blocks.h"

namespace kiln {
namespace {

class BlockCost final : public ceres::CostFunction {
 public:
  explicit BlockCost(const BrickBlock& block) : block_(block) {
    set_num_residuals(block.residuals());
    mutable_parameter_block_sizes()->push_back(4);
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    block_.evaluate(x[0], residuals, jacobians != nullptr ? jacobians[0] : nullptr);
    return true;
  }

 private:
  const BrickBlock& block_;
};

class PairCost final : public ceres::SizedCostFunction<PairBlock::kResiduals, 4, 4> {
 public:
  explicit PairCost(const PairBlock& block) : block_(block) {}
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    block_.evaluate(x[0], x[1], residuals, jacobians != nullptr ? jacobians[0] : nullptr,
                    jacobians != nullptr ? jacobians[1] : nullptr);
    return true;
  }

 private:
  const PairBlock& block_;
};

}  // namespace

ceres::CostFunction* newBlockCost(const BrickBlock& block) { return new BlockCost(block); }

SolveSummary solveBricks(std::span<const BrickBlock> blocks, std::span<const BrickPair> pairs,
                         std::span<UprightMotion> motions, const SolveLimits& limits) {
  KILN_CHECK(blocks.size() == motions.size(), blocks.size(), motions.size());
  ceres::Problem problem;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (!blocks[i].correspondences.empty() || blocks[i].hold.yaw > 0.0)
      problem.AddResidualBlock(newBlockCost(blocks[i]), nullptr, motions[i].data());
  for (const BrickPair& pair : pairs)
    problem.AddResidualBlock(new PairCost(pair.block), nullptr, motions[pair.a].data(),
                             motions[pair.b].data());
  SolveSummary out;
  if (problem.NumResidualBlocks() == 0) return out;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.parameter_tolerance = limits.parameter_tolerance;
  options.function_tolerance = limits.function_tolerance;
  options.max_num_iterations = limits.max_iterations;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  out.iterations = static_cast<int>(summary.iterations.size()) - 1;
  out.initial_cost = summary.initial_cost;
  out.final_cost = summary.final_cost;
  out.converged = summary.termination_type == ceres::CONVERGENCE;
  return out;
}

}  // namespace kiln
