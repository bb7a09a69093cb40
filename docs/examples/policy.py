"""Train a small policy on `ftc_jsb/Track-v0` by CMA-ES, and fly it: `ftc-jsb fly paper --loop policy:Policy`.

A policy of stable-baselines3 is flown the same way: `PPO("MlpPolicy", env).learn(100_000)` in `train`,
and `model.predict(observed, deterministic=True)[0]` in `step`.
"""

from pathlib import Path

import cmaes
import gymnasium
import numpy as np

from ftc_jsb.environment import ID, action_command, action_ranges, observation

FILE = Path(__file__).with_name("policy.npy")
SIZE = 3 * 12  # a row for each action, over 11 observations and a constant


def action(weights, observed):
    """Linear in the observation, bounded."""
    return np.tanh(weights.reshape(3, 12) @ np.append(observed, 1.0)).astype(np.float32)


def episode(env, weights, seed):
    """Mean reward of an episode; what a departure leaves unflown counts as nothing."""
    observed, _ = env.reset(seed=seed)
    total, steps, done = 0.0, 0, False
    while not done:
        observed, reward, terminated, truncated, _ = env.step(action(weights, observed))
        total, steps, done = total + reward, steps + 1, terminated or truncated
    return total / (steps if truncated else max(steps, 400))


def train(generations=60, episodes=2, seed=1, duration=20.0):
    """Weights of the best mean, and its reward in each generation."""
    env = gymnasium.make(ID, values={"duration": duration})
    search = cmaes.CMA(mean=np.zeros(SIZE), sigma=0.3, seed=seed)
    rewards = []
    for generation in range(generations):
        flown = []
        for _ in range(search.population_size):
            weights = search.ask()
            seeds = range(generation * episodes, (generation + 1) * episodes)
            flown.append((weights, -float(np.mean([episode(env, weights, s) for s in seeds]))))
        search.tell(flown)
        rewards.append(-min(loss for _, loss in flown))
    return search.mean, rewards


class Policy:
    """The trained policy as an outer loop; it decides as often as in training: every fifth sample."""

    HOLD = 5

    def __init__(self, setup):
        """Args: what every loop is built from."""
        self._weights = np.load(FILE)
        self._ranges = action_ranges(setup)
        self._asked = 0

    def step(self, time, measurement, reference):
        """Commands of a sample."""
        if self._asked % self.HOLD == 0:
            chosen = action(self._weights, observation(measurement, reference))
            self._command = action_command(chosen, self._ranges)
        self._asked += 1
        return self._command


if __name__ == "__main__":
    trained, history = train()
    np.save(FILE, trained)
    print(
        f"mean reward of a generation's best: {history[0]:.2f} at first, {history[-1]:.2f} at last"
    )
