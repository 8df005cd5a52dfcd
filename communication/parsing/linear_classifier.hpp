#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace castor::communication {

/// Which of several classes something belongs to, by a support vector machine for each class that
/// tells it from all others (linear, squared hinge loss).
///
/// Trained by dual coordinate descent (Hsieh et al., "A dual coordinate descent method for
/// large-scale linear SVM", 2008), of all classes at once: a tenth of the time of one after the
/// other, and the same for the same samples, which liblinear is not as others draw random numbers.
class LinearClassifier {
public:
  /// Of a sparse vector.
  struct Feature {
    std::size_t index = 0;
    float value = 0;
  };
  using Features = std::vector<Feature>;

  struct Sample {
    Features features;
    std::size_t label = 0;
  };

  /// \param samples whose indices of features are below `features`, and labels below `classes`
  LinearClassifier(std::span<const Sample> samples, std::size_t features, std::size_t classes);

  /// Of each class: above 0 if it is one of this class rather than one of the others; about 1 for
  /// what is plainly one.
  std::vector<float> scores(std::span<const Feature> features) const;

private:
  std::size_t classes_;
  /// Of each feature, those for all classes.
  std::vector<float> weights_;
};

} // namespace castor::communication
