#include "figure.hpp"

#include "text.hpp"

#include <algorithm>

namespace lab {

namespace {

// The last of a front that costs no more.
const Dot* best_at(const std::vector<Dot>& front, double cost) {
    const Dot* best = nullptr;
    for (const Dot& dot : front)
        if (dot.cost <= cost)
            best = &dot;
    return best;
}

} // namespace

bool Dot::off_scale() const {
    return letter == 'N' || letter == 'E' || letter == 'o' || !(error > 0);
}

std::vector<Dot> by_cost(std::vector<Dot> dots) {
    std::stable_sort(dots.begin(), dots.end(),
                     [](const Dot& a, const Dot& b) { return a.cost < b.cost; });
    return dots;
}

std::vector<Dot> dots_of(const Figure& figure) {
    std::vector<Dot> all;
    for (const Series& series : figure.series)
        all.insert(all.end(), series.dots.begin(), series.dots.end());
    return all;
}

std::vector<Dot> front_of(const std::vector<Dot>& dots) {
    std::vector<Dot> front;
    for (const Dot& dot : by_cost(dots))
        if (!dot.off_scale() && (front.empty() || dot.error < front.back().error))
            front.push_back(dot);
    return front;
}

std::vector<Dot> front_of(const Figure& figure) {
    return front_of(dots_of(figure));
}

std::string winners_markdown(const Figure& figure) {
    const auto dots = dots_of(figure);
    const bool baselines =
        std::any_of(dots.begin(), dots.end(), [](const Dot& dot) { return dot.baseline; });
    std::vector<Dot> own;
    for (const Dot& dot : dots)
        if (!dot.baseline)
            own.push_back(dot);
    const auto front = front_of(dots), own_front = front_of(own);
    std::string table = std::string("| from, ms | best | error |") +
                        (baselines ? " best of plait's models | error |" : "") +
                        "\n|---:|---|---:|" + (baselines ? "---|---:|" : "") + "\n";
    for (const Dot& dot : front) {
        table += text("| %.3g | %s%s | %.2g |", dot.cost, dot.name.c_str(),
                      dot.baseline ? " (baseline)" : "", dot.error);
        if (const Dot* ours = baselines ? best_at(own_front, dot.cost) : nullptr)
            table += text(" %s | %.2g |", ours->name.c_str(), ours->error);
        else if (baselines)
            table += " - | - |";
        table += "\n";
    }
    return table;
}

std::vector<std::string> left_out_by_reason(const std::vector<std::string>& left_out) {
    std::vector<std::pair<std::string, std::string>> reasons; // and who
    for (const std::string& line : left_out) {
        const size_t colon = line.find(": ");
        const std::string who = line.substr(0, colon), why = line.substr(colon + 2);
        const auto known = std::find_if(reasons.begin(), reasons.end(),
                                        [&](const auto& reason) { return reason.first == why; });
        if (known == reasons.end())
            reasons.emplace_back(why, who);
        else
            known->second += ", " + who;
    }
    std::vector<std::string> lines;
    for (const auto& [why, who] : reasons)
        lines.push_back(who + ": " + why);
    return lines;
}

} // namespace lab
