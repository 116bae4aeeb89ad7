#include "compare/judge/engine/diagnosis.hpp"

#include <nlohmann/json.hpp>

namespace ogc::compare {

namespace {

std::string cases(std::uint64_t count) { return std::to_string(count) + (count == 1 ? " case" : " cases"); }

std::string form_text(const Diagnosis& d) {
  if (d.name.empty())
    return "none of " + std::to_string(d.forms) + " known wrong forms fits the " + std::to_string(d.failing) +
           " failing cases that were looked at";
  std::string text = "your answer equals `" + d.name + "`: " + d.meaning + "\n  in " + std::to_string(d.fits) + " of " +
                     std::to_string(d.failing) + " failing cases that were looked at; ";
  text += d.otherwise == 0 ? "none of " + std::to_string(d.right) + " right ones speaks against it"
                           : "of " + std::to_string(d.right) + " right ones " + std::to_string(d.otherwise) +
                                 " are not of this form";
  for (std::size_t i = 0; i < d.as_well.size(); ++i)
    text += (i == 0 ? "\n  these cases do not tell it from `" : ", `") + d.as_well[i] + "`";
  for (const SecondMistake& second : d.seconds)
    text += "\n  in " + cases(second.fits) + " of the rest it equals `" + second.name + "`" +
            (second.together ? " together with that: " : ": ") + second.meaning;
  return text;
}

}  // namespace

std::string diagnosis_text(const Diagnosis& d) {
  std::string text = form_text(d) + "\n";
  if (!d.where.empty())
    text += "  all of them fail where " + d.where + "; " + cases(d.elsewhere) + " without that are right\n";
  return text;
}

nlohmann::ordered_json diagnosis_json(const Diagnosis& d) {
  auto seconds = nlohmann::ordered_json::array();
  for (const SecondMistake& second : d.seconds)
    seconds.push_back(
        {{"name", second.name}, {"meaning", second.meaning}, {"fits", second.fits}, {"together", second.together}});
  return {{"name", d.name},       {"meaning", d.meaning},     {"as_well", d.as_well}, {"fits", d.fits},
          {"failing", d.failing}, {"otherwise", d.otherwise}, {"right", d.right},     {"forms", d.forms},
          {"where", d.where},     {"elsewhere", d.elsewhere}, {"seconds", seconds}};
}

}  // namespace ogc::compare
