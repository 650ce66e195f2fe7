#include "acus/sim/person.h"

#include <algorithm>

#include "acus/sim/hill.h"
#include "acus/sim/tremor.h"

namespace acus {
namespace {

using Doing = Person::Doing;

bool stands_still(const Person& person, double time) {
  return time > person.still_from && time <= person.still_until;
}

// Of the aim. A hand that stands still gives way as one that pushes does, but does not go on.
double speed(const Person& person, const HandScene& hand, double force, double time) {
  const double in = hill_speed(force, hand.speed, hand.force_limit);
  const double out = hill_speed(-force, hand.speed, hand.force_limit);
  if (stands_still(person, time)) return std::min(in, 0.0) - std::min(out, 0.0);
  return person.doing == Doing::pulling ? -out : in;
}

// Feels, and when surprised resolves to pause. Until it has come to know what there is now, a little way
// after the pause, nothing more is news to it; pulling back it waits for nothing.
void feel(Person& person, const HandScene& hand, double force, double before, double time_step) {
  constexpr double settling = 1.5e-3;  // m, chosen: three attentive memories of felt.cpp
  const bool attentive = before < person.still_until || person.aim < person.settled;
  person.felt = felt_after(person.felt, person.travel, force, time_step, attentive);
  if (before >= person.still_from && before < person.still_until) {
    person.settled = person.aim + settling;
  } else if (!attentive && person.doing == Doing::pushing && hand.hesitation > 0.0 &&
             surprising(person.felt)) {
    person.still_from = before + hand.reaction;
    person.still_until = person.still_from + hand.hesitation;
  }
}

// What it does next, once it has gone as far or tried as long as it was asked to.
void turn(Person& person, const HandScene& hand, double time) {
  if (person.doing == Doing::pushing && (person.aim >= hand.travel || time >= hand.duration)) {
    person.doing = hand.pulls_back ? Doing::pulling : Doing::nothing_more;
    person.turned = person.still_from = time;
    person.still_until = time + hand.hesitation;
  } else if (person.doing == Doing::pulling &&
             (person.aim <= 0.0 || time - person.turned >= hand.hesitation + hand.duration)) {
    person.doing = Doing::nothing_more;
  }
}

}  // namespace

Person person_after(Person person, const HandScene& hand, double force, double time_step) {
  const double before = static_cast<double>(person.steps) * time_step;
  const double time = static_cast<double>(++person.steps) * time_step;
  feel(person, hand, force, before, time_step);
  const double wanted = person.aim + time_step * speed(person, hand, force, time);
  person.aim = std::clamp(wanted, 0.0, hand.travel);
  person.travel = person.aim + tremor(hand.tremor, hand.seed, time);
  turn(person, hand, time);
  return person;
}

double longest_trial(const HandScene& hand) {
  return hand.pulls_back ? 2.0 * hand.duration + hand.hesitation : hand.duration;
}

}  // namespace acus
