"""The public API, which `import ftc_jsb` offers: flights, comparisons, sweeps and what is measured by them."""

from ftc_jsb.api.campaigns import Campaign as Campaign
from ftc_jsb.api.campaigns import campaign as campaign
from ftc_jsb.api.comparison import Comparison as Comparison
from ftc_jsb.api.comparison import compare as compare
from ftc_jsb.api.flight import Flight as Flight
from ftc_jsb.api.flight import Moment as Moment
from ftc_jsb.api.flying import fly as fly
from ftc_jsb.api.flying import load as load
from ftc_jsb.api.measured import Identification as Identification
from ftc_jsb.api.measured import Margins as Margins
from ftc_jsb.api.measured import identify as identify
from ftc_jsb.api.measured import margins as margins
from ftc_jsb.api.scenarios import Scenario as Scenario
from ftc_jsb.api.scenarios import scenario as scenario
from ftc_jsb.api.sweep import Sweep as Sweep
from ftc_jsb.api.sweep import sweep as sweep
from ftc_jsb.control.protocol import Command as Command
from ftc_jsb.control.protocol import LoopSetup as LoopSetup
from ftc_jsb.control.protocol import Measurement as Measurement
from ftc_jsb.control.protocol import Reference as Reference
from ftc_jsb.errors import UserError as UserError
