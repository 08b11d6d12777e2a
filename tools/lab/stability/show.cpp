#include "methods/models.hpp"
#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace lab::stability {

namespace {

bool is_map(const Row& row) {
    return row.job.kind == "map";
}

bool bends(const std::string& label) {
    const Model* model = find_model(label);
    return model && model->bends && model->model != PLAIT_MODEL_TRESSFX;
}

const Shake& shake_of(const Row& row) {
    for (const Shake& shake : shakes())
        if (row.column == shake.label)
            return shake;
    throw Failure("no motion is called \"" + row.column + "\"");
}

// "model setting", in the order they came.
std::vector<std::string> subjects_of(const std::vector<Row>& rows, bool map) {
    std::vector<std::string> subjects;
    for (const Row& row : rows) {
        const std::string subject = row.job.model + " " + row.job.setting;
        if (is_map(row) == map && std::ranges::find(subjects, subject) == subjects.end())
            subjects.push_back(subject);
    }
    return subjects;
}

// Letters of one subject's map.
using Letters = std::map<std::tuple<double, uint32_t, double>, std::string>;

Letters letters_of(const std::vector<Row>& rows, const std::string& subject) {
    Letters letters;
    for (const Row& row : rows) {
        if (!is_map(row) || row.job.model + " " + row.job.setting != subject)
            continue;
        const Place& p = row.job.place;
        std::string& block = letters[{p.rate, p.segments, p.gamma}];
        block.resize(shakes().size(), ' ');
        block[static_cast<size_t>(&shake_of(row) - shakes().data())] = letter_of(row.outcome.grade);
    }
    return letters;
}

void print_subject(const Letters& letters, const std::string& subject) {
    std::set<double> gammas;
    std::set<std::pair<double, uint32_t>> lines;
    for (const auto& [at, block] : letters) {
        lines.insert({std::get<0>(at), std::get<1>(at)});
        gammas.insert(std::get<2>(at));
    }
    std::printf("\n%s\n    Hz    N", subject.c_str());
    for (const double gamma : gammas)
        std::printf(" %-7s", text_of(gamma).c_str());
    for (const auto& [rate, segments] : lines) {
        std::printf("\n  %4g  %3u", rate, segments);
        for (const double gamma : gammas) {
            const auto found = letters.find({rate, segments, gamma});
            std::printf(" %s", found == letters.end() ? "       " : found->second.c_str());
        }
    }
    std::puts("");
}

} // namespace

void print_map(const std::vector<Row>& rows) {
    const auto subjects = subjects_of(rows, true);
    if (subjects.empty())
        return;
    std::printf("Each letter a motion of the root for 2 s:");
    for (const Shake& shake : shakes())
        std::printf(" %s%s", shake.label, &shake == &shakes().back() ? "\n" : ",");
    std::puts("(shaking at 2 Hz). Columns: gamma = rho A g L^3 / EI.\n"
              "N not finite or 100 L away, E gains energy, F frozen, J jitters at rest,\n"
              "s strain above 10 % while shaken, r above 1 % at rest, . none of these.");
    for (const std::string& subject : subjects)
        print_subject(letters_of(rows, subject), subject);
}

void print_axes(const std::vector<Row>& rows) {
    for (const std::string& subject : subjects_of(rows, false)) {
        std::printf("\n%s, one parameter at a time\n", subject.c_str());
        std::string axis;
        for (const Row& row : rows) {
            if (is_map(row) || row.job.model + " " + row.job.setting != subject)
                continue;
            if (row.job.kind != axis)
                std::printf("%s  %-22s", axis.empty() ? "" : "\n", row.job.kind.c_str());
            axis = row.job.kind;
            std::printf(" %s:%c", row.column.c_str(), letter_of(row.outcome.grade));
        }
        std::puts("");
    }
}

std::vector<Count> count_letters(const std::vector<Row>& rows) {
    std::vector<Count> counts;
    for (const Row& row : rows) {
        const std::string method = row.job.model + " " + row.job.setting;
        auto count = std::ranges::find(counts, method, &Count::method);
        if (count == counts.end())
            count = counts.insert(count, Count{method});
        ++count->trials;
        ++count->letters[static_cast<size_t>(row.outcome.grade)];
        const bool limp_rod = std::isinf(row.job.place.gamma) && bends(row.job.model);
        const bool in = is_map(row) && !limp_rod && in_envelope(row.job.place, shake_of(row));
        count->inside += in;
        count->missed += in && row.outcome.grade != Grade::pass;
    }
    return counts;
}

void print_count(const std::vector<Row>& rows) {
    std::puts("\n                     trials      N      E      F      J      s      r      .   "
              "inside the envelope, missed");
    for (const Count& count : count_letters(rows)) {
        std::printf("%-21s %5zu", count.method.c_str(), count.trials);
        for (const size_t n : count.letters)
            std::printf(" %6zu", n);
        std::printf("   %zu, %zu\n", count.inside, count.missed);
    }
    std::puts(
        "(the envelope: 60 Hz and above, N <= 64, gamma >= 1 and not limp for rods, <= 10 g)");
}

std::string counts_markdown(const std::vector<Row>& rows) {
    std::string text =
        "| method | trials | N | E | F | J | s | r | pass | inside the envelope | of "
        "them missed |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    const auto cell = [&](size_t n) { text.append(std::to_string(n)).append(" | "); };
    for (const Count& count : count_letters(rows)) {
        text.append("| ").append(count.method).append(" | ");
        cell(count.trials);
        for (const size_t n : count.letters)
            cell(n);
        cell(count.inside);
        cell(count.missed);
        text.back() = '\n';
    }
    return text;
}

std::string axes_markdown(const std::vector<Row>& rows) {
    const auto subjects = subjects_of(rows, false);
    std::vector<std::string> axes;
    std::map<std::string, std::string> values, whose;                   // by axis
    std::map<std::pair<std::string, std::string>, std::string> letters; // by axis and subject
    for (const Row& row : rows) {
        if (is_map(row))
            continue;
        const std::string subject = row.job.model + " " + row.job.setting;
        if (std::ranges::find(axes, row.job.kind) == axes.end())
            axes.push_back(row.job.kind);
        if (whose.try_emplace(row.job.kind, subject).first->second == subject)
            values[row.job.kind] += (values[row.job.kind].empty() ? "" : ", ") + row.column;
        letters[{row.job.kind, subject}] += letter_of(row.outcome.grade);
    }
    std::string text = "| parameter | values |", rule = "\n|---|---|";
    for (const std::string& subject : subjects) {
        text += " " + subject + " |";
        rule += "---|";
    }
    text += rule;
    for (const std::string& axis : axes) {
        text += "\n| " + axis + " | " + values[axis] + " |";
        for (const std::string& subject : subjects)
            text += letters.contains({axis, subject}) ? " `" + letters[{axis, subject}] + "` |"
                                                      : " n/a |"; // pins
    }
    return text + "\n";
}

} // namespace lab::stability
