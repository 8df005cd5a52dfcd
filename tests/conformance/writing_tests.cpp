#include "castor/tests/conformance/basic_tests.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace castor::conformance {

namespace {

class SingleWrite final : public Test {
public:
  using Test::Test;

  void run() override {
    add(0);
    if (!(*tester_.read<TestStruct>(addresses_[0]) == written_[0]))
      return fail("what is read is not what was added");
    for (int i = 1; i < 5; ++i)
      add(i);
    // Others may write here as well.
    std::vector<TestStruct> own;
    for (auto& entry : tester_.read_all_in<TestStruct>(tester_.home()))
      if (entry.writer == tester_.component_name())
        own.push_back(*entry);
    std::reverse(own.begin(), own.end());
    if (own != written_)
      return fail("reading all entries of the type does not yield the five that were added, the "
                  "newest first, but " +
                  std::to_string(own.size()));
    if (auto newest = tester_.read_all_in<TestStruct>(tester_.home(), 4).size(); newest != 4)
      return fail("reading four entries of the type yields " + std::to_string(newest));
    pass();
  }

  std::string awaited() const override { return "its own entries"; }

private:
  void add(int count) {
    addresses_.push_back(tester_.new_address());
    written_.push_back(tester_.made(Operation::add, addresses_.back(), count));
    tester_.add(addresses_.back(), written_.back());
  }

  std::vector<Address> addresses_;
  std::vector<TestStruct> written_;
};

class ReadWrite final : public Test {
public:
  using Test::Test;

  void start() override {
    address_ = tester_.new_address();
    written_ = tester_.made(Operation::add, address_, 1);
    when_others(added<TestStruct>().in(tester_.home()), [this](const ChangeEvent& event) {
      if (*tester_.read<TestStruct>(event.address) == written_)
        pass();
      else
        fail(to_string(event.address) + " of " + event.source + " is no copy of " +
             to_string(address_));
    });
  }

  void run() override { tester_.add(address_, written_); }

  std::string awaited() const override { return "a copy of its entry"; }

private:
  Address address_;
  TestStruct written_;
};

class Copy final : public Test {
public:
  using Test::Test;

  void start() override {
    when_others(added<TestStruct>().in(tester_.home()), [this](const ChangeEvent& event) {
      tester_.add(tester_.new_address(), *tester_.read<TestStruct>(event.address));
      pass();
    });
  }

  std::string awaited() const override { return "an entry to copy"; }
};

class Write final : public Test {
public:
  Write(Tester& tester, std::int64_t entries) : Test(tester), entries_(entries) {}

  void run() override {
    for (std::int64_t i = 0; i < entries_; ++i) {
      auto address = tester_.new_address();
      tester_.add(address, tester_.made(Operation::add, address, i));
    }
    pass();
  }

  std::string awaited() const override { return "its own entries"; }

private:
  std::int64_t entries_;
};

class Count final : public Test {
public:
  Count(Tester& tester, std::int64_t entries, std::int64_t authors, std::chrono::milliseconds quiet)
    : Test(tester), entries_(entries), authors_(authors), quiet_(quiet) {}

  void start() override {
    when(added<TestStruct>().anywhere(), [this](const ChangeEvent& event) { hear(event); });
  }

  std::string awaited() const override {
    auto result = "the entries of everybody: " + std::to_string(complete_) + " are complete";
    for (auto& [author, next] : next_)
      result += ", " + author + " is to add count " + std::to_string(next);
    return result;
  }

private:
  void hear(const ChangeEvent& event) {
    auto count = tester_.read<TestStruct>(event.address)->count;
    auto& next = next_[event.source];
    if (count != next)
      return fail(event.source + " was to add count " + std::to_string(next) + ", but " +
                  to_string(event.address) + " has count " + std::to_string(count));
    if (++next == entries_) {
      next_.erase(event.source);
      ++complete_;
    }
    end_perhaps();
  }

  void end_perhaps() {
    if (authors_ > 0 ? complete_ < authors_ : !next_.empty())
      return;
    if (authors_ > 0 || tester_.idle_for(quiet_))
      pass();
    else
      tester_.post(*this, [this] { end_perhaps(); });
  }

  std::int64_t entries_;
  std::int64_t authors_;
  std::chrono::milliseconds quiet_;
  /// Of those that are on the way.
  std::map<std::string, std::int64_t> next_;
  std::int64_t complete_ = 0;
};

} // namespace

std::unique_ptr<Test> single_write(Tester& tester) {
  return std::make_unique<SingleWrite>(tester);
}

std::unique_ptr<Test> read_write(Tester& tester) {
  return std::make_unique<ReadWrite>(tester);
}

std::unique_ptr<Test> copy(Tester& tester) {
  return std::make_unique<Copy>(tester);
}

std::unique_ptr<Test> write(Tester& tester, std::int64_t entries) {
  return std::make_unique<Write>(tester, entries);
}

std::unique_ptr<Test> count(Tester& tester, std::int64_t entries, std::int64_t authors,
                            std::chrono::milliseconds quiet) {
  return std::make_unique<Count>(tester, entries, authors, quiet);
}

} // namespace castor::conformance
