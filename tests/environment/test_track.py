"""`ftc_jsb/Track-v0`: Gymnasium accepts it, episodes repeat, end as they should, and are what `fly` flies."""

import importlib
from pathlib import Path

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from ftc_jsb.control.protocol import Command
from ftc_jsb.environment import ID, action_command, action_ranges, observation
from ftc_jsb.environment.sampled_flight import SampledFlight
from ftc_jsb.errors import UserError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.simulation.fly import fly

SHORT = {"duration": 6.0}


class Level:
    """A loop that holds level flight, by the action that the environment takes."""

    ACTION = np.array([-0.2, 0.0, 0.1], np.float32)

    def __init__(self, setup):
        self._ranges = action_ranges(setup)

    def step(self, time, measurement, reference):
        return action_command(self.ACTION, self._ranges)


def _made(**given):
    return gymnasium.make(ID, **{"values": SHORT, **given})


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
@pytest.mark.filterwarnings("ignore:.*not able to test alternative render modes.*")
def test_gymnasium_accepts_it(model):
    check_env(_made(model=model).unwrapped)


def _episode(env, seed):
    env.action_space.seed(seed)
    seen = [env.reset(seed=seed)[0]]
    done = False
    while not done:
        observed, reward, terminated, truncated, _ = env.step(env.action_space.sample())
        assert 0.0 <= reward <= 1.0
        seen.append(observed)
        done = terminated or truncated
    return np.array(seen), terminated, truncated


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_a_seed_repeats_an_episode_to_the_bit(model):
    values = {**SHORT, "sensors.profile": "tactical", "wind.turbulence": "moderate"}
    first, again = (_episode(_made(model=model, values=values), 7) for _ in range(2))
    other = _episode(_made(model=model, values=values), 8)
    assert first[0].tobytes() == again[0].tobytes()
    assert first[0].tobytes() != other[0].tobytes()


def test_the_end_of_the_scenario_is_truncation():
    env = _made(model="paper")
    env.reset(seed=1)
    for step in range(120):  # 6 s in steps of 0.05 s
        _, _, terminated, truncated, _ = env.step(Level.ACTION)
        assert not terminated
        assert truncated == (step == 119)


@pytest.mark.parametrize("model", ["paper", "jsbsim"])
def test_a_departure_is_termination_with_a_reason_and_numbers(model):
    """Full bank and a push: into the ground, or past the vertical."""
    env = _made(model=model, values={"initial.altitude": 500.0, "duration": 60.0})
    env.reset(seed=1)
    terminated = truncated = False
    while not (terminated or truncated):
        observed, reward, terminated, truncated, info = env.step([1.0, -1.0, 0.0])
        assert env.observation_space.contains(observed)
    assert terminated
    assert not truncated
    assert reward == 0.0
    assert info["reason"]


def test_what_is_not_a_number_is_seen_as_bounded():
    flying = SampledFlight(load_scenario("paper", ["duration=1"]))
    lost = flying.measurement._replace(airspeed=np.nan, altitude=1e12, bank_angle=-np.inf)
    seen = observation(lost, flying.reference)
    assert np.all(np.isfinite(seen))
    assert np.abs(seen).max() == 20.0


@pytest.mark.parametrize("model", ["paper", "identified", "jsbsim"])
def test_an_episode_is_the_flight_that_fly_flies(model):
    """The same action as a loop of one's own: every recorded command and state is the same to the bit."""
    env = _made(model=model, fault_probability=0.0).unwrapped
    env.reset(seed=3, options={"fault[0].start": 2.0})
    truncated = False
    while not truncated:
        truncated = env.step(Level.ACTION)[3]
    episode = env.recorded()
    loop = episode.scenario.loop.model_copy(update={"name": f"{__name__}:Level"})
    flown = fly(episode.scenario.model_copy(update={"loop": loop})).record[
        : episode.record.size - 1
    ]
    assert episode.record["effectiveness_thrust"][-1] == 0.6
    for name in ("airspeed", "heading", "altitude", "thrust", "thrust_cmd", "bank_angle"):
        assert flown[name].tobytes() == episode.record[name][:-1].tobytes(), name


def test_actions_are_commands():
    ranges = action_ranges(SampledFlight(load_scenario("paper", ["duration=1"])).setup)
    assert action_command([-1.0, 0.0, 0.0], ranges) == Command(0.0, 1.0, 0.0)
    most = action_command([5.0, 1.0, -1.0], ranges)  # beyond the space: bounded
    assert (most.thrust, most.load_factor) == (ranges.thrust, ranges.load_factor_max)
    assert np.degrees(most.bank_angle) == pytest.approx(-80.0)


def test_random_losses_are_drawn_and_can_be_given():
    env = _made(fault_probability=1.0).unwrapped
    left = {
        env.reset(seed=s)[1] and env.recorded().scenario.fault[0].effectiveness for s in range(5)
    }
    assert len(left) == 5
    assert all(0.4 <= value <= 0.9 for value in left)
    env.reset(options={"fault": []})
    assert env.recorded().scenario.fault == ()


def test_it_is_vectorized():
    envs = gymnasium.make_vec(ID, num_envs=2, values=SHORT)
    observed, _ = envs.reset(seed=1)
    assert observed.shape == (2, 11)
    envs.step(envs.action_space.sample())
    envs.close()


def test_bad_settings_are_refused():
    with pytest.raises(UserError, match="unknown key 'wings'"):
        _made(values={"wings": 2})
    with pytest.raises(ValueError, match="hold of 1 or more"):
        _made(hold=0)


def test_the_example_trains_and_its_policy_flies_as_a_loop(tmp_path, monkeypatch):
    """Two generations: that the pieces fit; what a policy learns is not judged."""
    place = Path(__file__).parents[2] / "docs" / "examples"
    (tmp_path / "policy.py").write_text((place / "policy.py").read_text(encoding="utf-8"))
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    policy = importlib.import_module("policy")
    weights, rewards = policy.train(generations=2, episodes=1, duration=2.0)
    assert len(rewards) == 2
    np.save(policy.FILE, weights)
    flown = fly(load_scenario("paper", ["duration=2", "loop.name='policy:Policy'"]))
    assert flown.outcome.status in ("complete", "departed")
    changes = np.flatnonzero(np.diff(flown.record["thrust_cmd"])) + 1
    assert np.all(changes % policy.Policy.HOLD == 0)
