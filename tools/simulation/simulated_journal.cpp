#include "castor/tools/simulation/simulated_journal.hpp"

#include "castor/wm/journal/journal_image.hpp"

#include <utility>

namespace castor::simulation {

class SimulatedDisk::Journal final : public JournalFile {
public:
  explicit Journal(std::shared_ptr<File> file)
    : file_(std::move(file)), session_(file_->session()) {}

  void append(const std::vector<JournalGroupPtr>& groups) override {
    check_session();
    for (auto& group : groups)
      for (auto& record : *group) {
        auto& x = file_->records.emplace_back(record);
        x.session = session_;
        x.before = {};
      }
  }

  bool tidy() override { return false; }
  void close() override {
    check_session();
    file_->is_complete = true;
  }
  std::uint64_t bytes() const override { return file_->records.size(); }

private:
  void check_session() const {
    if (file_->session() != session_)
      throw JournalError("the journal was taken up by another working memory");
  }

  std::shared_ptr<File> file_;
  const std::uint64_t session_;
};

OpenedJournal SimulatedDisk::open(const std::string& subarchitecture, const JournalOptions& options,
                                  UnixTime now) {
  auto& file = files_[subarchitecture];
  if (!file)
    file = std::make_shared<File>();
  JournalImage image{subarchitecture, options.remembered_deletions};
  for (auto& x : file->records) {
    image.begin_incarnation(file->sessions[x.session - 1]);
    image.apply(x);
  }
  auto incarnation = file->sessions.empty() ? 0 : file->sessions.back();
  if (!file->is_complete)
    ++incarnation;
  image.begin_incarnation(incarnation);
  file->sessions.push_back(incarnation);
  file->is_complete = options.mode == JournalMode::full && !options.go_on_without;
  OpenedJournal result;
  result.file = std::make_shared<Journal>(file);
  result.image = image.store();
  result.session = file->session();
  result.incarnation = incarnation;
  result.time = now;
  return result;
}

const std::vector<JournalRecord>& SimulatedDisk::records(const std::string& subarchitecture) const {
  static const std::vector<JournalRecord> none;
  auto i = files_.find(subarchitecture);
  return i == files_.end() ? none : i->second->records;
}

caf::behavior simulated_journal_writer(caf::event_based_actor* self) {
  return {
    [self](const BeginJournal& x) { self->become(journal_writer(self, *x.parts)); },
  };
}

} // namespace castor::simulation
