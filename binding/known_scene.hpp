#pragma once

#include "castor/binding/binding_view.hpp"
#include "castor/binding/types.hpp"

#include <map>
#include <string>
#include <vector>

namespace castor::binding {

/// What there is, as far as somebody perceives it or says so when asked.
struct KnownScene {
  std::map<std::string, BindingUnion> unions;
  /// Distinct and sorted.
  std::vector<UnionRelation> relations;

  /// Adds what somebody competent says. What it says of a proxy's thing is added to its union.
  void add(const KnowledgeCompetence& from, KnowledgeReply told);
};

/// Without what is only said or wished: descriptions do not confirm themselves.
KnownScene perceived(const BindingView& view);

} // namespace castor::binding
