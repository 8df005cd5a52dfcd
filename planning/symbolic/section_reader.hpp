#pragma once

#include "castor/planning/symbolic/reading_context.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Sections of PDDL files, and the domain's file as a whole.
namespace castor::planning {

/// The word that sections begin with, and what reads them.
using Section = std::pair<std::string_view, std::function<void(const SyntaxNode&)>>;

/// Reads the lists within (define (KIND NAME) ...), in the order of their readers; the name.
std::string read_sections(ReadingContext& context, const std::vector<SyntaxNode>& top,
                          std::string_view kind, const std::vector<Section>& readers);

/// Adds a type without supertypes.
void declare_type(ReadingContext& context, std::string_view name);

// Sections of domains and of problems.
void read_requirements(ReadingContext& context, const SyntaxNode& section);
void read_objects(ReadingContext& context, const SyntaxNode& section);

void read_domain(ReadingContext& context, const std::vector<SyntaxNode>& top);

/// A derived predicate must not depend on its own negation.
void check_stratification(ReadingContext& context, const SyntaxNode& domain);

} // namespace castor::planning
