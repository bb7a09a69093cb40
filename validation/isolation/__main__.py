"""`python -m validation.isolation WHAT`: whose fault is it?

`table [SEEDS] [FIRST]` flies every class of faults on every fighter, in four airs, with perfect and tactical
sensors; `rates [HOURS] [FIRST]` flies without a fault and counts alarms; `roc [SEEDS] [FIRST]` weighs losses of
thrust that are found against alarms by chance; `bound [SEEDS] [FIRST]` holds the estimate's error against the
Cramér–Rao bound; `learn` prints `ftc_jsb/isolation/scatter.py` anew, from seeds 100 to 103. Seeds of the others
begin at 17000: nothing was chosen by them.
"""

import sys

from validation.isolation.bound import bounds
from validation.isolation.learn import learn
from validation.isolation.rates import rates
from validation.isolation.roc import roc
from validation.isolation.table import table

MADE = {
    "table": lambda numbers: table(*map(int, numbers)),
    "roc": lambda numbers: roc(*map(int, numbers)),
    "bound": lambda numbers: bounds(*map(int, numbers)),
    "learn": lambda _: learn(),
    "rates": lambda numbers: rates(*numbers[:1], *map(int, numbers[1:])),
}

if __name__ == "__main__":
    for line in MADE[sys.argv[1]]([float(each) for each in sys.argv[2:]]):
        print(line, flush=True)
