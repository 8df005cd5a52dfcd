#pragma once

#include "castor/benchmarks/semeval/robot_commands/board.hpp"
#include "castor/benchmarks/semeval/robot_commands/rcl_tree.hpp"

#include <cstdint>
#include <vector>

namespace castor::semeval {

/// A possible referent of an entity of a command: a block, a stack, or a part of the board.
struct Referent {
  /// One bit for every cell that it covers, number 8 x + y.
  std::uint64_t cells = 0;
  /// Its lowest and highest level; both -1 for parts of the board.
  int bottom = -1;
  int top = -1;
  /// The block; null for other referents.
  const Block* block = nullptr;
};

/// Finds the referents of a command's entities on a board.
class Grounding {
public:
  /// @param command resolves references within it; both have to outlive this
  Grounding(const Board& board, const RclTree& command);

  /// All referents that an entity describes; a relation to another entity holds if it holds to any
  /// of its referents.
  std::vector<Referent> referents(const RclTree& entity) const;

  /// Those of `candidates` that have this relation to a referent in the relation tree.
  std::vector<Referent> related(const std::vector<Referent>& candidates,
                                const RclTree& relation) const;

  /// Whether nothing lies upon it.
  bool is_clear(const Referent& referent) const;

private:
  std::vector<Referent> of_type(const RclTree& entity) const;
  std::vector<Referent> blocks(const RclTree& entity, std::string_view type) const;
  std::vector<Referent> stacks(const RclTree& entity) const;
  std::vector<Referent> groups(const RclTree& entity) const;
  std::vector<Referent> selected(std::vector<Referent> candidates,
                                 std::string_view indicator) const;
  const RclTree* antecedent(const RclTree& tree) const;

  const Board& board_;
  const RclTree& command_;
};

} // namespace castor::semeval
