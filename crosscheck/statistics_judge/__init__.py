"""Recomputes what verdicts.toml says from the stored trials: estimates, intervals and classes.

Written from the documentation of the criteria, with numpy and scipy alone; pyarrow does nothing but read the
Parquet files. What is random is drawn anew, with more resamples and another generator, so that a bootstrap
interval agrees if its ends lie where Monte-Carlo error alone can put them. The default interpretation's rows of
estimates.parquet are compared with the same recomputation, on the instances that an exploration keeps.

Not recomputed: the rules (arithmetic on printed numbers; their certificates have a verifier of their own),
what other explored interpretations say, sets of claims met together, and whether path lengths keep to the
inclusion of one planner's steps in another's (`by_inclusion`). The stored class of a rule is taken as given where
claims are combined.
"""
